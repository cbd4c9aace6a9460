"""What `using A = B` and typedefs stand for, looked up the way a compiler would."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Container, Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.facts import Alias

if TYPE_CHECKING:
    from ecm_extract.link.units import File

Declared = tuple["File", Alias]
"""An alias with the file it stands in."""


class Aliases:
    """The aliases of a program; `nearness` tells how close a file is to another (`Program.nearness`)."""

    def __init__(self, nearness: Callable[[File, File], int]) -> None:
        self._nearness = nearness
        self._entries: dict[str, list[Declared]] = defaultdict(list)

    def add(self, file: File, alias: Alias) -> None:
        """Remember an alias of a file."""
        self._entries[alias.name].append((file, alias))

    def find(self, name: str, file: File, scope: str = "") -> Declared | None:
        """Return the declaration that a name means in a scope of a file, the nearest of several."""
        entries = self._entries.get(name.rsplit("::", 1)[-1])
        if not entries:
            return None
        enclosing = set(enclosing_scopes(scope.removeprefix("::")))
        fitting = [(other, alias) for other, alias in entries if _fits(alias, name) and _is_known(alias, enclosing)]
        near = [(self._nearness(other, file), other, alias) for other, alias in fitting]
        near = [entry for entry in near if entry[0] > 0]
        if not near:
            return None
        best = max(
            near,
            key=lambda entry: (_is_named(entry[2], name), entry[2].scope.removesuffix("()") in enclosing, entry[0]),
        )
        return best[1], best[2]

    def targets(self, name: str) -> Iterator[tuple[File, str]]:
        """Yield what the aliases of a name stand for, each with the file that declares it."""
        for file, alias in self._entries.get(name, ()):
            yield file, alias.target

    def meaning(self, classes: Container[str], beside: Container[str] = ()) -> frozenset[str]:
        """Return the names of aliases that may stand for some classes; one may be called like those `beside`."""
        return frozenset(
            name
            for name, entries in self._entries.items()
            if name not in classes and any(self._means(alias, classes, beside) for _, alias in entries)
        )

    def _means(self, alias: Alias, classes: Container[str], beside: Container[str]) -> bool:
        last = _last_of(alias.target)
        return last in classes or (last in beside and last != alias.name)


def enclosing_scopes(scope: str) -> list[str]:
    """`a::b` -> [`a::b`, `a`, ``]."""
    parts = scope.split("::") if scope else []
    return ["::".join(parts[:count]) for count in range(len(parts), -1, -1)]


def _fits(alias: Alias, name: str) -> bool:
    if "::" not in name:
        return True
    return _is_named(alias, name) or name.endswith("::" + _qualified(alias))


def _is_known(alias: Alias, enclosing: set[str]) -> bool:
    """Tell whether a place can know an alias at all: one within a function is known there only."""
    return not alias.local or alias.scope[:-2] in enclosing


def _is_named(alias: Alias, name: str) -> bool:
    """Tell whether a qualified name means this alias and not one of the same name elsewhere."""
    qualified = _qualified(alias)
    return qualified == name or qualified.endswith("::" + name)


def _qualified(alias: Alias) -> str:
    return f"{alias.scope}::{alias.name}" if alias.scope else alias.name


def _last_of(target: str) -> str:
    """The last name of a type as written, without template arguments."""
    words = target.split("<", 1)[0].split()
    return words[-1].rsplit("::", 1)[-1] if words else ""
