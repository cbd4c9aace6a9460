"""Definitions of message types: of the tree first, then of the distributions that rosbags knows.

Type stores are loaded one at a time and only when a type is asked for that the tree does not hold.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import PurePosixPath
from typing import Any

from ecm_checker.contract import Evidence
from ecm_parsers.interface import parse
from ecm_parsers.interface_facts import Definition, Section
from ecm_parsers.interface_hash import Hashed, md5, rihs01

from ecm_extract.read.facts import PackageFacts

_ROS1_STORES = ("ROS1_NOETIC",)
_ROS2_STORES = (
    *("ROS2_LYRICAL", "ROS2_KILTED", "ROS2_JAZZY", "ROS2_IRON", "ROS2_HUMBLE"),
    *("ROS2_GALACTIC", "ROS2_FOXY", "ROS2_ELOQUENT", "ROS2_DASHING"),
)
"""Newest first: a type that several distributions have is taken from the newest."""


class Definitions:
    """Resolves full type names, `package/msg|srv|action/Name`."""

    def __init__(self, packages: Sequence[PackageFacts]) -> None:
        packages = sorted(packages, key=lambda package: package.root.path)  # of one name the same one is meant always
        self._tree = {
            f"{package.name}/{definition.shape}/{PurePosixPath(path).stem}": definition
            for package in packages
            for path, definition in package.interfaces.items()
        }
        self._paths = {
            f"{package.name}/{definition.shape}/{PurePosixPath(path).stem}": path
            for package in packages
            for path, definition in package.interfaces.items()
        }
        self._stores: dict[str, Any] = {}
        self._known: dict[tuple[str, int], Definition | None] = {}

    def units(self, name: str, section: str) -> dict[str, str]:
        """Return field -> unit of a section of a type of the tree, as its comments and REP 103 names tell."""
        return {
            field.name: field.unit
            for part in self._sections(name, section)
            for field in part.fields
            if field.unit is not None
        }

    def constants(self, name: str, section: str) -> Iterator[tuple[str, Evidence]]:
        """Yield (constant, line) of a section of a type of the tree."""
        for part in self._sections(name, section):
            for constant in part.constants:
                yield constant.name, Evidence(self._paths[name], constant.line)

    def _sections(self, name: str, section: str) -> list[Section]:
        definition = self._tree.get(name)
        return [part for part in definition.sections if part.name == section] if definition is not None else []

    def fingerprint(self, name: str, definition: Definition, ros: int | None) -> Hashed:
        """Return the MD5 sum (ROS 1) or RIHS01 hash (else) of a type, or which type is missing for it."""
        return md5(name, definition, self.resolver(1)) if ros == 1 else rihs01(name, definition, self.resolver(2))

    def resolver(self, ros: int) -> Callable[[str], Definition | None]:
        """Return the look-up of a ROS version."""
        return lambda name: self.definition(name, ros)

    def definition(self, name: str, ros: int) -> Definition | None:
        """Return the definition of a type, None when neither the tree nor a distribution has it."""
        if name in self._tree:
            return self._tree[name]
        key = (name, ros)
        if key not in self._known:
            self._known[key] = self._of_distribution(name, ros)
        return self._known[key]

    def _of_distribution(self, name: str, ros: int) -> Definition | None:
        for label in _ROS1_STORES if ros == 1 else _ROS2_STORES:
            store = self._store(label)
            if store is not None and name in store.fielddefs:
                text = store.generate_msgdef(name, ros_version=ros)[0].split("=" * 80, 1)[0]
                return parse(text.encode(), "msg").facts
        return None

    def _store(self, label: str) -> Any:
        """Return a type store; None when this release of rosbags does not have it."""
        if label not in self._stores:
            from rosbags.typesys import Stores, get_typestore

            found = getattr(Stores, label, None)
            self._stores[label] = get_typestore(found) if found is not None else None
        return self._stores[label]
