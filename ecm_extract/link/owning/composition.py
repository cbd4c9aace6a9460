"""What runs in one process: the modules of each program, and the nodes that a module makes inside itself."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

from ecm_parsers.source.expr import Expr, Text

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.owning.modules import Module, Modules
from ecm_extract.link.owning.references import References, Unit

MAX_USERS = 4_000
_NAMESPACE = "__ns:="
_LOADER = re.compile(r"ClassLoader\s*<(.+)>")


class Part(NamedTuple):
    """A module in a program or inside another module.

    `name` is what its maker calls its node, None when the module itself decides; `nested` tells that it puts its node
    into a namespace of its own name.
    """

    module: Module
    name: str | None = None
    nested: bool = False


@dataclass(frozen=True, slots=True)
class Composition:
    """Programs by (package, executable); by module its parts, and bases of plugins that it loads all of."""

    programs: dict[tuple[str, str], list[Part]] = field(default_factory=lambda: defaultdict(list))
    parts: dict[Module, list[Part]] = field(default_factory=lambda: defaultdict(list))
    loads: dict[Module, set[str]] = field(default_factory=lambda: defaultdict(set))


def composition_of(modules: Modules, references: References) -> Composition:
    """Return which modules run in which program and inside which other module."""
    found = Composition()
    for module in modules.programs():
        found.programs[module.package, module.name].append(Part(module))
    composer = _Composer(modules, references)
    for module in modules.by_class.values():
        composer.place(module, found)
    for base, unit in composer.loaders():
        for module in modules.owners(unit):
            found.loads[module].add(base)
    return found


class _Composer:
    """Follows who makes a module class up to the programs and modules in which that happens."""

    def __init__(self, modules: Modules, references: References) -> None:
        self.modules = modules
        self.references = references

    def place(self, module: Module, found: Composition) -> None:
        """Add a module to the programs and modules that make it."""
        assert module.cls is not None
        named = self.modules.registry.names.get(module.cls)
        if named is not None:
            _add(found.programs[module.package, named], Part(module))
        calls = list(self._making(module.cls))
        nested = _nests(module.cls)
        for unit in self._outermost(module.cls):
            if isinstance(unit, Func):
                registry = self.modules.registry
                for built in registry.builds.get(unit, {"": registry.programs[unit]}).values():
                    _add(found.programs[unit.file.package, built], Part(module))
                continue
            owner = self.modules.by_class[unit]
            for name in self._names(calls, unit) or [None]:
                _add(found.parts[owner], Part(module, name, nested))

    def loaders(self) -> Iterator[tuple[str, Unit]]:
        """Yield (base class, unit) of the loaders that take every class that plugin descriptions declare."""
        sites = self.references.sites
        for call in sites.calls.get("getDeclaredClasses", ()):
            if call.receiver is None:
                continue
            written = sites.folder.objects.type_of(call.receiver, sites.root_env(call.func, call.at))
            match = _LOADER.search(written or "")
            if match is not None:
                yield match[1].strip(), call.func.holder or call.func

    def _outermost(self, cls: Cls) -> Iterator[Unit]:
        """Yield the main functions and module classes in which an object of a class is made."""
        seen: set[Unit] = {cls}
        pending = list(self.references.makers(cls))
        while pending and len(seen) < MAX_USERS:
            unit = pending.pop()
            if unit in seen:
                continue
            seen.add(unit)
            is_module = isinstance(unit, Cls) and unit in self.modules.by_class
            if isinstance(unit, Cls) and cls in self.references.program.ancestry(unit):
                continue  # a base is a part of the object, not an object of its own
            if is_module or unit in self.modules.registry.programs:
                yield unit
            if not is_module:
                pending.extend(self.references.users(unit))

    def _making(self, cls: Cls) -> Iterable[Invocation]:
        return list(self.references.sites.makers(cls))

    def _names(self, calls: Iterable[Invocation], unit: Cls) -> list[str | None]:
        """Return what a class calls the nodes that it makes: the argument for a parameter that is a name."""
        names: dict[str | None, None] = {}
        sites = self.references.sites
        for call in calls:
            if call.func.cls is not unit or not call.args:
                continue
            value = sites.folder.fold(call.args[0], sites.root_env(call.func, call.at))[0]
            if value.confidence != "pattern" and value.text and _plain(value.text):
                names.setdefault(value.text)
        return list(names)


def _plain(text: str) -> bool:
    return text.replace("_", "").isalnum()


def _add(parts: list[Part], part: Part) -> None:
    if part not in parts:
        parts.append(part)


def _nests(cls: Cls) -> bool:
    """Tell whether the sources of a class give its node a namespace by a remap rule."""
    files = dict.fromkeys(method.file for method in cls.methods if method.file.language == "cpp")
    return any(
        statement.value is not None and _mentions_namespace(statement.value)
        for file in files
        for function in file.facts.functions
        for statement in function.body
    )


def _mentions_namespace(expr: Expr) -> bool:
    pending: list[object] = [expr]
    while pending:
        current = pending.pop()
        if isinstance(current, Text) and current.value.startswith(_NAMESPACE):
            return True
        if isinstance(current, tuple):
            pending.extend(current)
        elif hasattr(current, "__struct_fields__"):
            pending.extend(getattr(current, name) for name in current.__struct_fields__)
    return False
