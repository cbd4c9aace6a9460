"""What a Python name means: declarations of its file, imports, star imports, attributes of modules and classes."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import chain
from posixpath import dirname
from typing import NamedTuple

from ecm_parsers.source.facts import Import

from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.resolve.cpp_constants import Stated
from ecm_extract.resolve.cpp_scopes import enclosing_scopes, joined
from ecm_extract.resolve.paths import tree_path
from ecm_extract.resolve.python_path import PythonPath

_GENERATED = frozenset({"msg", "srv", "action"})
"""Modules that a package has for what it generates (docs.ros.org, rosidl_generator_py; wiki.ros.org, msg)."""
MAX_HOPS = 16
"""How many re-exports are followed from module to module."""


class Module(NamedTuple):
    """A module of the tree by its path, as `PythonPath` has it."""

    path: str


Symbol = Module | Cls | Func | Stated


@dataclass(slots=True)
class Declarations:
    """What a file declares, by qualified name, and the imports that bind a name."""

    symbols: dict[str, list[Symbol]] = field(default_factory=lambda: defaultdict(list))
    imports: dict[str, list[Import]] = field(default_factory=lambda: defaultdict(list))
    stars: list[Import] = field(default_factory=list)


class PythonNames:
    """Looks up names of Python files.

    Args:
        path: finds modules.
        bases: gives the bases of a class, at any distance.
    """

    def __init__(self, path: PythonPath, bases: Callable[[Cls], Sequence[Cls]]) -> None:
        self._path = path
        self._bases = bases
        self._files: dict[File, Declarations] = defaultdict(Declarations)

    def add(self, file: File, classes: Iterable[Cls], functions: Iterable[Func]) -> None:
        """Make what a file declares known; a class that it declares twice counts as its first."""
        known = self._files[file]
        for cls in classes:
            if cls.qualified not in known.symbols:
                known.symbols[cls.qualified].append(cls)
        for func in functions:
            known.symbols[joined(func.fact.scope, func.fact.name)].append(func)
        for constant in file.facts.constants:
            known.symbols[joined(constant.scope, constant.name)].append(Stated(file, constant))
        for entry in file.facts.imports:
            if entry.name == "*":
                known.stars.append(entry)
            else:
                known.imports[entry.alias or entry.name or entry.module.partition(".")[0]].append(entry)

    def find(self, name: str, file: File, scope: str = "") -> tuple[Symbol, ...]:
        """Return everything that a dotted name can mean in a scope of a file; empty of what is outside the tree.

        Args:
            name: as written, or with what the file imports put in for its first part.
            file: in which it stands.
            scope: in which it stands, the function included.
        """
        dotted = name.replace("::", ".")
        parts = dotted.split(".")
        found = () if dotted.startswith(".") else self._walk(self._bound(parts[0], file, scope, 0), parts[1:], 0)
        return tuple(dict.fromkeys(chain(found, self._imported(dotted, file))))

    def outside(self, dotted: str, file: File, hops: int = 0) -> str:
        """Return what a dotted name that a file imports is called outside of the tree, by whatever modules hand it on.

        Empty for what the tree declares, and for what no import binds.
        """
        head, _, rest = dotted.partition(".")
        known = self._files.get(file)
        if known is None or hops > MAX_HOPS:
            return ""
        for entry in known.imports.get(head, ()):
            bound = entry.module if not entry.name else f"{entry.module}.{entry.name}"
            full = dotted if not (entry.name or entry.alias) else f"{bound}.{rest}".rstrip(".")
            if "." not in full:
                return full
            handed = self._handed_on(full, file)
            if handed is None or self._is_generated(full, *handed):
                return full
            return self.outside(handed[1], handed[0], hops + 1)
        starred = (
            () if head in known.symbols else (self._outside_star(entry, dotted, file, hops) for entry in known.stars)
        )
        return next((found for found in starred if found), "")

    def _is_generated(self, full: str, package: File, rest: str) -> bool:
        """Whether a name is one of a message of a package of the tree: nobody writes its module `package.msg`."""
        kind = rest.partition(".")[0]
        known = self._files[package]
        return kind in _GENERATED and full.count(".") == 2 and kind not in known.symbols and kind not in known.imports

    def _outside_star(self, entry: Import, dotted: str, file: File, hops: int) -> str:
        """What a name is called outside of the tree that a module of the tree hands on by a star."""
        module = self._path.find(entry.module, file)
        inner = self._path.file(module) if module is not None else None
        return self.outside(dotted, inner, hops + 1) if inner is not None else ""

    def _handed_on(self, full: str, file: File) -> tuple[File, str] | None:
        """The module of the tree that the first parts of a name mean, and what is asked of it; None without one."""
        parts = full.split(".")
        for count in range(len(parts), 0, -1):
            module = self._path.find(".".join(parts[:count]), file)
            inner = self._path.file(module) if module is not None else None
            if inner is not None:
                return inner, ".".join(parts[count:])
        return None

    def _imported(self, name: str, file: File) -> Iterator[Symbol]:
        """What a name means whose first parts are a module that the file imports."""
        rest = name.lstrip(".")
        dots = name[: len(name) - len(rest)]
        parts = rest.split(".")
        if not dots and parts[0] not in {entry.module.partition(".")[0] for entry in file.facts.imports}:
            return
        for count in range(0 if dots else 1, len(parts) + 1):
            module = self._path.find(dots + ".".join(parts[:count]), file)
            if module is not None:
                yield from self._walk((Module(module),), parts[count:], 0)

    def _walk(self, symbols: Iterable[Symbol], parts: Sequence[str], hops: int) -> tuple[Symbol, ...]:
        found = tuple(symbols)
        for part in parts:
            found = tuple(dict.fromkeys(each for symbol in found for each in self._attribute(symbol, part, hops)))
        return found

    def _bound(self, name: str, file: File, scope: str, hops: int) -> tuple[Symbol, ...]:
        """What a name without a dot means in a scope of a file."""
        known = self._files.get(file)
        if known is None or hops > MAX_HOPS:
            return ()
        for prefix in enclosing_scopes(scope.removeprefix("::")):
            own = known.symbols.get(joined(prefix, name), ()) if prefix else ()
            if own and (prefix == scope or not _is_class(known.symbols.get(prefix, ()))):
                return tuple(own)
        found = [*known.symbols.get(name, ())]
        for entry in known.imports.get(name, ()):
            found += self._entry(entry, file, hops)
        if found or name in known.imports:
            return tuple(dict.fromkeys(found))
        starred = (self._starred(entry, name, file, hops) for entry in known.stars)
        return next((symbols for symbols in starred if symbols), ())

    def _entry(self, entry: Import, file: File, hops: int) -> tuple[Symbol, ...]:
        """What an import binds: a module, the first part of its name, or an attribute of it."""
        module = self._path.find(entry.module, file)
        if not entry.name:
            below = 0 if entry.alias else entry.module.count(".")
            return (Module(_up(module, below)),) if module is not None else ()
        found = self._attribute(Module(module), entry.name, hops) if module is not None else ()
        if found:
            return found
        dot = "" if entry.module.endswith(".") else "."
        inner = self._path.find(f"{entry.module}{dot}{entry.name}", file)
        return (Module(inner),) if inner is not None else ()

    def _starred(self, entry: Import, name: str, file: File, hops: int) -> tuple[Symbol, ...]:
        module = self._path.find(entry.module, file)
        return self._attribute(Module(module), name, hops) if module is not None else ()

    def _attribute(self, symbol: Symbol, name: str, hops: int) -> tuple[Symbol, ...]:
        if isinstance(symbol, Module):
            return self._of_module(symbol, name, hops)
        return self._of_class(symbol, name) if isinstance(symbol, Cls) else ()

    def _of_module(self, module: Module, name: str, hops: int) -> tuple[Symbol, ...]:
        file = self._path.file(module.path)
        found = self._bound(name, file, "", hops + 1) if file is not None else ()
        inner = tree_path(module.path, name)
        return found or ((Module(inner),) if self._path.has(inner) else ())

    def _of_class(self, cls: Cls, name: str) -> tuple[Symbol, ...]:
        for owner in (cls, *self._bases(cls)):
            own = self._files[owner.file].symbols.get(joined(owner.qualified, name), ())
            if own:
                return tuple(own)
        return ()


def _up(path: str, count: int) -> str:
    for _ in range(count):
        path = dirname(path)
    return path


def _is_class(symbols: Iterable[Symbol]) -> bool:
    """Names of a class are not in the scope of its methods."""
    return any(isinstance(symbol, Cls) for symbol in symbols)
