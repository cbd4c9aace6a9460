"""What `using A = B`, `using b::A`, typedefs and `namespace a = b` declare."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container, Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from ecm_parsers.source.facts import Alias

from ecm_extract.link.code.units import File


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
                if alias.target == alias.name:
                    continue  # `typedef struct Part Part;`, `using Part = Part;`: what it means stands without it
                entry = Declared(file, alias)
                found[f"{entry.scope}::{alias.name}" if entry.scope else alias.name].append(entry)
        self.by_name: Mapping[str, Sequence[Declared]] = found
        self._by_last_name: dict[str, list[Declared]] = defaultdict(list)
        for entry in self._all():
            self._by_last_name[entry.alias.name].append(entry)
        self.last_names = frozenset(self._by_last_name)

    def called(self, name: str) -> Sequence[Declared]:
        """Return the aliases whose last name this is, in any scope."""
        return self._by_last_name.get(name, ())

    def meaning(self, classes: Container[str], beside: Container[str] = ()) -> frozenset[str]:
        """Return the names of aliases that may stand for some classes; one may be called like those `beside`."""
        return frozenset(
            entry.alias.name
            for entry in self._all()
            if entry.alias.name not in classes and _means(entry.alias, classes, beside)
        )

    def _all(self) -> Iterator[Declared]:
        return (entry for entries in self.by_name.values() for entry in entries)


def _means(alias: Alias, classes: Container[str], beside: Container[str]) -> bool:
    last = _last_of(alias.target)
    return last in classes or (last in beside and last != alias.name)


def _last_of(target: str) -> str:
    """The last name of a type as written, without template arguments."""
    words = target.split("<", 1)[0].split()
    return words[-1].rsplit("::", 1)[-1] if words else ""
