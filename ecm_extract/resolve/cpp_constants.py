"""Which named value outside of functions a C++ name means: constants, static members, macros, variables."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Sequence
from typing import NamedTuple

from ecm_parsers.source.facts import Constant

from ecm_extract.link.code.units import File
from ecm_extract.resolve.cpp_scopes import Scopes, joined
from ecm_extract.resolve.outcome import Ambiguous, External
from ecm_extract.resolve.views import View, Views


class Stated(NamedTuple):
    """A constant with the file it stands in."""

    file: File
    constant: Constant


def is_defined(constant: Constant) -> bool:
    """Tell whether a variable has its storage where it is written; `static` members have it there only with a value."""
    return constant.value is not None or not {"extern", "static"} & set(constant.traits)


class CppConstants:
    """Looks up constants over what a translation unit sees, and their values in what is linked with it.

    Args:
        scopes: spells out names.
        views: what files see.
    """

    def __init__(self, scopes: Scopes, views: Views) -> None:
        self._scopes = scopes
        self._views = views
        self._by_name: dict[str, list[Stated]] = defaultdict(list)

    def add(self, file: File, constant: Constant) -> None:
        """Make a constant known; a value of an `enum` that is no class is known around that too."""
        stated = Stated(file, constant)
        self._by_name[joined(constant.scope, constant.name)].append(stated)
        if constant.type and "enum" in constant.traits and "scoped" not in constant.traits:
            self._by_name[joined(constant.scope.rpartition("::")[0], constant.name)].append(stated)

    def find(self, name: str, file: File, scope: str) -> Stated | Ambiguous[Stated] | External:
        """Return what a name means in a scope of a file; one that is declared only where no value is known."""
        for view in dict.fromkeys((self._views.of(file), self._views.wide(file))):
            found = self._within(name, scope, view)
            surely = found if view.surely is view else self._within(name, scope, view.surely)
            if surely and surely != found:  # in another part of the function it means another
                return Ambiguous(tuple(dict.fromkeys((*found, *surely))))
            if found:
                return _one(found)
        return External(name)

    def _within(self, name: str, scope: str, view: View) -> list[Stated]:
        """What the innermost scope has that has any, with the values elsewhere of what is only declared."""
        for level in self._scopes.levels(name, scope, view):
            found = [entry for each in level for entry in self._by_name.get(each, ()) if entry.file in view]
            if found:
                return [*found, *self._elsewhere(level, found)]
        return []

    def _elsewhere(self, level: Sequence[str], found: Sequence[Stated]) -> list[Stated]:
        """The values of what is only declared here: `extern`, or a static member."""
        if any(is_defined(entry.constant) for entry in found):
            return []
        packages = {entry.file.package for entry in found}
        others = (entry for each in level for entry in self._by_name.get(each, ()))
        return [entry for entry in others if entry.constant.value is not None and entry.file.package in packages]


def _one(found: Sequence[Stated]) -> Stated | Ambiguous[Stated]:
    """One that has the value, where all that have one have the same."""
    valued = [entry for entry in found if entry.constant.value is not None] or found
    first = valued[0]
    if all(entry.constant.value == first.constant.value for entry in valued):
        return first
    return Ambiguous(tuple(valued))
