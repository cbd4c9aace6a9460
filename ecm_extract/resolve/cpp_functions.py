"""Which functions outside of classes a C++ name means: its overloads, declared and defined."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

from ecm_extract.link.code.spelling import plain
from ecm_extract.link.code.units import File, Func
from ecm_extract.resolve.aliases import Aliases
from ecm_extract.resolve.cpp_scopes import Scopes, joined
from ecm_extract.resolve.views import View, Views

MAX_USINGS = 4
"""How many using-declarations are followed from one to the next."""


class CppFunctions:
    """Looks up functions over what a translation unit sees, and their definitions in what is linked with it.

    Args:
        scopes: spells out names.
        views: what files see.
        aliases: of the tree, using-declarations among them.
    """

    def __init__(self, scopes: Scopes, views: Views, aliases: Aliases) -> None:
        self._scopes = scopes
        self._views = views
        self._aliases = aliases
        self._by_name: dict[str, list[Func]] = defaultdict(list)

    def add(self, func: Func) -> None:
        """Make a function known."""
        self._by_name[joined(func.fact.scope, func.fact.name)].append(func)

    def find(self, name: str, file: File, scope: str, depth: int = 0) -> tuple[Func, ...]:
        """Return the functions that a name means in a scope of a file, in the order of files; empty for none.

        It is empty as well where the name means others in another part of the function.
        """
        for view in dict.fromkeys((self._views.of(file), self._views.wide(file))):
            found = self._within(name, file, scope, depth, view)
            surely = self._within(name, file, scope, depth, view.surely) if view.surely is not view else found
            if surely and surely != found:
                return ()
            if found is not None:
                return found
        return ()

    def _within(self, name: str, file: File, scope: str, depth: int, view: View) -> tuple[Func, ...] | None:
        """The functions in the innermost scope that has any; None where no scope does."""
        for level in self._scopes.levels(name, scope, view):
            if self._is_taken(level, view):
                return ()
            found = self._declared(level, view)
            if found:
                return (*found, *self._defined(level, found, file))
            used = self._used(level, view, depth)
            if used:
                return used
        return None

    def _declared(self, level: Sequence[str], view: View) -> list[Func]:
        return [func for each in level for func in self._by_name.get(each, ()) if func.file in view]

    def _is_taken(self, level: Sequence[str], view: View) -> bool:
        """Whether a block of the function takes the name, which is written whole where it stands for that alone."""
        entries = (entry for each in level for entry in self._aliases.by_name.get(each, ()))
        return any(entry.alias.scope.endswith("()") and entry.file in view for entry in entries)

    def _used(self, level: Sequence[str], view: View, depth: int) -> tuple[Func, ...]:
        """What `using a::f` brings into a scope."""
        entries = [entry for each in level for entry in self._aliases.by_name.get(each, ()) if entry.file in view]
        if depth >= MAX_USINGS:
            return ()
        found = (self.find(plain(entry.alias.target), entry.file, entry.scope, depth + 1) for entry in entries)
        return tuple(dict.fromkeys(func for funcs in found for func in funcs))

    def _defined(self, level: Sequence[str], found: Sequence[Func], file: File) -> Iterator[Func]:
        """The definitions elsewhere of what is only declared; of several for the same arguments those of the target."""
        packages = {func.file.package for func in found}
        counts = {len(types) for types in _undefined(found)}
        by_types: dict[tuple[str, ...], list[Func]] = defaultdict(list)
        for func in (func for each in level for func in self._by_name.get(each, ())):
            if func not in found and func.file.package in packages and _is_linked(func):
                by_types[_types(func)].append(func)
        for types, funcs in by_types.items():
            if len(types) not in counts:
                continue
            same = [func for func in funcs if set(func.file.targets) & set(file.targets)]
            left = same or funcs
            yield from left if len({func.file for func in left}) == 1 else ()


def _types(func: Func) -> tuple[str, ...]:
    return tuple(plain(entry.type) for entry in func.fact.params)


def _undefined(found: Sequence[Func]) -> set[tuple[str, ...]]:
    """The parameters of what is declared here, and not defined here too."""
    defined = {_types(func) for func in found if not _is_declaration(func)}
    return {_types(func) for func in found if _is_declaration(func)} - defined


def _is_declaration(func: Func) -> bool:
    return "declaration" in func.fact.traits


def _is_linked(func: Func) -> bool:
    """Tell whether other files can call a function that they declare."""
    return not _is_declaration(func) and not {"static", "anonymous"} & set(func.fact.traits)
