"""The packages of a question, as providers and as consumers of each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property

import msgspec

from ecm_checker.hub.kinds import uses
from ecm_checker.hub.package import Package, provisions
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.engine import Match, is_open, match
from ecm_checker.match.provisions import Provisions


class Unmet(msgspec.Struct, frozen=True):
    """A requirement that is not met, whose it is, and what met it before; `before` is empty where nothing is known."""

    consumer: str
    match: Match
    before: tuple[Provision, ...] = ()

    @property
    def requirement(self) -> Requirement:
        """What is required."""
        return self.match.requirement


class Packages:
    """What some packages provide and require together.

    Attributes:
        names: of the packages, all of whose provisions are here.
    """

    def __init__(self, packages: Sequence[Package]) -> None:
        self._packages = tuple(packages)
        self.names = frozenset(package.name for package in packages)

    @cached_property
    def provisions(self) -> Provisions:
        """All that they provide."""
        entities = [each for package in self._packages for each in provisions(package.name, package).values()]
        return Provisions(entities, frozenset(name for package in self._packages for name in package.bound))

    @cached_property
    def consumers(self) -> Sequence[Consumer]:
        """Each of them as a consumer."""
        return [Consumer(package.name, package.requires) for package in self._packages]

    def version(self, name: str) -> str | None:
        """Return the version of a package; None where it is not here, or declares none."""
        return next((each.version for each in self._packages if each.name == name), None)

    @cached_property
    def _file_names(self) -> frozenset[tuple[str, str]]:
        return frozenset((each.name, path.rpartition("/")[2]) for each in self._packages for path in each.files)

    def _is_file(self, requirement: Requirement) -> bool:
        """Whether a program is a file of its package: ROS 1 runs it from the source folder, installed or not."""
        return requirement.kind == "executable" and (requirement.package, requirement.name) in self._file_names

    def unmet(self) -> Iterator[Unmet]:
        """Yield what they require of each other and do not get.

        What any package of the world may provide is left out: whether it meets is decided where modules run together.
        """
        for consumer in self.consumers:
            for requirement in consumer.requirements:
                if uses()[requirement.use].stated and not is_open(requirement) and not self._is_file(requirement):
                    found = match(requirement, consumer, self.provisions, self.names)
                    if found.state in {"dangling", "incompatible"}:
                        yield Unmet(consumer.package, found)


def broken(users: Packages, before: Packages, after: Packages) -> Iterator[Unmet]:
    """Yield what users got of a release and do not get of the next one (paper, "Release Discipline").

    Args:
        users: the packages that require.
        before: the packages of the old release.
        after: those of the new one: all that was met before must be met by them.
    """
    for consumer in users.consumers:
        for requirement in consumer.requirements:
            was = match(requirement, consumer, before.provisions, before.names)
            if was.state != "met":
                continue
            now = match(requirement, consumer, after.provisions, after.names)
            if now.state != "met":
                yield Unmet(consumer.package, now, was.found)
