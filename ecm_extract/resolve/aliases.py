"""What `using A = B`, `using b::A`, typedefs and `namespace a = b` declare."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Iterable, Mapping, Sequence
from typing import NamedTuple

from ecm_parsers.source.facts import Alias

from ecm_extract.link.units import File


class Declared(NamedTuple):
    """An alias with the file it stands in."""

    file: File
    alias: Alias

    @property
    def scope(self) -> str:
        """Where it stands; within a function the function."""
        return self.alias.scope.removesuffix("()")


class Aliases:
    """The aliases of a tree by their qualified names."""

    def __init__(self, files: Iterable[File]) -> None:
        found: dict[str, list[Declared]] = defaultdict(list)
        for file in files:
            for alias in file.facts.aliases:
                entry = Declared(file, alias)
                found[f"{entry.scope}::{alias.name}" if entry.scope else alias.name].append(entry)
        self.by_name: Mapping[str, Sequence[Declared]] = found
        self.last_names = frozenset(entry.alias.name for entries in found.values() for entry in entries)

    def meaning(self, classes: Container[str]) -> frozenset[str]:
        """Return the names of aliases that may stand for one of some classes."""
        return frozenset(
            entry.alias.name
            for entries in self.by_name.values()
            for entry in entries
            if entry.alias.name not in classes and _last_of(entry.alias.target) in classes
        )


def _last_of(target: str) -> str:
    """The last name of a type as written, without template arguments."""
    words = target.split("<", 1)[0].split()
    return words[-1].rsplit("::", 1)[-1] if words else ""
