"""Names that meet what packages require and that no release is compared by: rows whose kind says `compared = false`."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ecm_checker.hub.provision import Provision
from ecm_parsers.launch.model import LaunchFile

from ecm_extract.entities.exported_classes import aliases_of, exported_classes
from ecm_extract.entities.launch_values import launch_values
from ecm_extract.entities.python_names import python_names
from ecm_extract.read.facts import PackageFacts


class InnerNames:
    """What packages of one tree have so, each asked for when it is wanted."""

    def __init__(self, packages: Sequence[PackageFacts]) -> None:
        self._aliases = aliases_of(packages)

    def of(self, facts: PackageFacts, launches: Iterable[tuple[str, LaunchFile]]) -> Iterator[Provision]:
        """Yield those of one package; `launches` are its launch files by path."""
        yield from exported_classes(facts, self._aliases)
        yield from launch_values(facts, launches)
        yield from python_names(facts)
