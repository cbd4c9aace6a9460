"""Modules: which classes and programs have a contract, and which of them an endpoint belongs to.

A class that derives from a node, controller or hardware base, or that is registered as a plugin or component, is a
module; so is a program whose endpoints stand in no such class. An endpoint of a helper class belongs to every module
that uses the helper; one that nobody uses belongs to the package's library.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence, Set
from dataclasses import dataclass, field

from ecm_checker.match.generated import snake

from ecm_extract.link.code.units import Cls, File, Func
from ecm_extract.link.index.module_kinds import class_kind
from ecm_extract.link.index.program import Program
from ecm_extract.link.owning.loaded_nodelets import loaded_nodelets
from ecm_extract.link.owning.references import References, Unit
from ecm_extract.source_suffixes import is_included

MAX_USERS = 4000
_REGISTRATION_KINDS = {"RCLCPP_COMPONENTS_REGISTER_NODE": "component", "NODELET": "nodelet"}
_LOADED = ("PLUGIN", "CLASS_LOADER", "NODE", "COMPONENT", "CONTROLLER", "FILTER", "DISPLAY", "HARDWARE")
"""Words in macros that hand a class to a loader; those for point types, graph edges or metatypes have none of them."""


@dataclass(frozen=True, slots=True, eq=False)
class Module:
    """A module before its contract is written.

    Attributes:
        package: name of its package. name: own name, unique in the package.
        kind: as in the contract. cls: its class; None for a program or library.
        main: main function of a program.
        path, line: where it is declared.
        target: what builds it of a program whose main function several targets compile; empty for any.
    """

    package: str
    name: str
    kind: str
    cls: Cls | None
    main: Func | None
    path: str
    line: int
    target: str = ""


@dataclass(slots=True)
class Registry:
    """What the build files and macros say is a module.

    Attributes:
        classes: class -> kind, of plugins and components.
        names: class -> name that a loader or executable gives it.
        programs: main function -> executable name.
        builds: main function that several targets compile -> these, with the names of their executables.
        starting: package -> its targets that are no libraries: programs and tests.
        libraries: source path -> library name.
        lookups: name that a loader asks for -> class.
    """

    classes: dict[Cls, str] = field(default_factory=dict)
    names: dict[Cls, str] = field(default_factory=dict)
    programs: dict[Func, str] = field(default_factory=dict)
    builds: dict[Func, Mapping[str, str]] = field(default_factory=dict)
    starting: dict[str, Set[str]] = field(default_factory=dict)
    libraries: dict[str, str] = field(default_factory=dict)
    lookups: dict[str, Cls] = field(default_factory=dict)


class Modules:
    """Finds modules and attributes units to them."""

    def __init__(self, program: Program, references: References, registry: Registry) -> None:
        self.program = program
        self.references = references
        self.registry = registry
        self.by_class: dict[Cls, Module] = {}
        self.by_main: dict[Func, Module] = {}
        self.twins: dict[Module, Sequence[Module]] = {}
        self.libraries: dict[tuple[str, str], Module] = {}
        self.loaded = loaded_nodelets(references.sites, registry.lookups)
        self._loaders = {cls: [func for func, made in self.loaded.items() if cls in made] for cls in _all(self.loaded)}
        self._owners: dict[Unit, tuple[Module, ...]] = {}

    def find(self, node_name: Mapping[Cls, str]) -> None:
        """Make the modules of all classes that are modules, and of programs.

        Args:
            node_name: class -> node name, where a constructor fixes it.
        """
        for group in self.program.classes.values():
            for cls in group:
                kind = self._kind(cls)
                if kind is not None:
                    name = node_name.get(cls) or self.registry.names.get(cls) or snake(cls.fact.name)
                    self.by_class[cls] = Module(cls.file.package, name, kind, cls, None, cls.file.path, cls.fact.line)

    def is_module(self, cls: Cls) -> bool:
        """Tell whether a class has a contract of its own."""
        return self._kind(cls) is not None

    def is_program(self, func: Func) -> bool:
        """Tell whether a function is the main one of a program."""
        return func in self.registry.programs

    def _kind(self, cls: Cls) -> str | None:
        if not cls.file.is_built:
            return None
        registered = self.registry.classes.get(cls)
        kind = class_kind(cls, self.program)
        if registered is not None:
            return kind if kind not in {None, "node"} else "component" if kind == "node" else registered
        if kind is None or not self._concrete(cls):
            return None
        return kind

    def _concrete(self, cls: Cls) -> bool:
        """A class of the tree that others derive from and that nobody makes is a base, not a module."""
        if any("pure" in method.fact.traits for method in cls.methods):
            return False
        sites = self.references.sites
        if not sites.program.derived(cls):
            return not cls.fact.template
        made = any(not sites.making.is_base_of(call, cls) for call in sites.makers(cls))
        return made or any(True for _ in self.references.asking(cls))

    def owners(self, unit: Unit) -> tuple[Module, ...]:
        """Return the modules that have the endpoints of a unit: itself, those that use it, or the library."""
        known = self._owners.get(unit)
        if known is None:
            known = self._owners[unit] = self._find_owners(unit)
        return known

    def _find_owners(self, unit: Unit) -> tuple[Module, ...]:
        if not unit.file.is_built:
            return ()
        found: dict[Module, None] = {}
        seen: set[Unit] = {unit}
        pending = [unit]
        while pending and len(seen) < MAX_USERS:
            current = pending.pop()
            module = self._own(current)
            if module is not None:
                found[module] = None
            for user in self._users(current, module):
                if user not in seen:
                    seen.add(user)
                    pending.append(user)
        if not found and not isinstance(unit, Cls) and unit.cls is not None:
            return self.owners(unit.cls)
        if not found:
            return (self.library(unit),)
        every = (each for module in found for each in (module, *self.twins.get(module, ())))
        return tuple(sorted(every, key=lambda module: (module.package, module.name, module.path)))

    def _users(self, unit: Unit, module: Module | None) -> Iterable[Unit]:
        """A module class passes its endpoints on to who derives from it or loads it, a script to who imports it."""
        if module is None:
            return self.references.users(unit)
        if not isinstance(unit, Cls):
            return self.references.importers(unit)
        loaders = (func.holder or func for func in self._loaders.get(unit, ()))
        return (*self.references.sites.program.derived(unit), *loaders)

    def _own(self, unit: Unit) -> Module | None:
        if isinstance(unit, Cls):
            return self.by_class.get(unit)
        name = self.registry.programs.get(unit)
        if name is None:
            return None
        module = self.by_main.get(unit)
        if module is None:
            module = self.by_main[unit] = self._started(unit, name)
        return module

    def _started(self, unit: Func, name: str) -> Module:
        """A program that is started in two ways, by its file and by a function of it, is one."""
        known = (each for each in self.by_main.values() if each.path == unit.file.path and each.name == name)
        kind = "script" if unit.file.language == "python" else "node"
        builds = self.registry.builds.get(unit) or {"": name}
        made = [
            Module(unit.file.package, built, kind, None, unit, unit.file.path, unit.fact.line, target)
            for target, built in builds.items()
        ]
        self.twins[made[0]] = made[1:]
        return next(known, made[0])

    def library(self, unit: Unit) -> Module:
        """Return the library module of the package of a unit."""
        file = unit.file
        name = self.registry.libraries.get(file.path) or file.package
        key = (file.package, name)
        if key not in self.libraries:
            self.libraries[key] = Module(file.package, name, "library", None, None, file.path, 1)
        return self.libraries[key]

    def is_of_programs_only(self, file: File) -> bool:
        """Tell whether only programs compile a source, whose main functions are known: nobody else runs what it has."""
        mains = (func.file for func in self.registry.programs if func.file.package == file.package)
        return self._is_only_of(file, {target for main in mains for target in main.targets})

    def _is_only_of(self, file: File, targets: Set[str]) -> bool:
        """Whether a source is compiled by some targets only, and is no library's and no header."""
        if not file.targets or is_included(file.path) or file.path in self.registry.libraries:
            return False
        return set(file.targets) <= targets

    def links(self, module: Module, func: Func) -> bool:
        """Tell whether a program can have a function: not that of a source which only other programs compile."""
        file, main = func.file, module.main
        if main is None or file.package != module.package or not (file.all_targets and main.file.targets):
            return True
        own = {module.target} if module.target else set(main.file.targets)
        shares = set(file.targets) & own or file in self.program.included(main.file)
        return bool(shares) or not self._is_only_of(file, self.registry.starting.get(file.package, frozenset()))

    def note(self, programs: Iterable[Func]) -> None:
        """Make modules of programs that are nodes, though no endpoint is theirs."""
        for main in programs:
            if main.file.is_built:
                self._own(main)

    def all(self) -> Sequence[Module]:
        """Return every module found so far."""
        return [*self.by_class.values(), *self.programs(), *self.libraries.values()]

    def in_order(self) -> list[Module]:
        """Return every module found so far, in a stable order."""
        return sorted(self.all(), key=lambda module: (module.package, module.name, module.path, module.line))

    def programs(self) -> Sequence[Module]:
        """Return every program found so far; one whose main function several targets compile for each of them."""
        started = dict.fromkeys(self.by_main.values())
        return [each for module in started for each in (module, *self.twins.get(module, ()))]


def _all(loaded: Mapping[Func, Sequence[Cls]]) -> set[Cls]:
    return {cls for made in loaded.values() for cls in made}


def registration_kind(macro: str) -> str | None:
    """Return the kind that a registration macro makes of its class; None for a macro that registers other things."""
    known = _REGISTRATION_KINDS.get(macro)
    return known or ("plugin" if any(word in macro for word in _LOADED) else None)
