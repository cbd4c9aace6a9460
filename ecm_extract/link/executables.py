"""Which modules a program runs: its own, and every module class that an object of is made in it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from ecm_extract.link.modules import Module, Modules
from ecm_extract.link.program import Cls
from ecm_extract.link.references import References, Unit

MAX_USERS = 4_000
Executables = dict[tuple[str, str], tuple[Module, ...]]
"""(package, executable) -> its modules."""


def executables_of(modules: Modules, references: References) -> Executables:
    """Return the modules of each executable, the module that the program is named after first."""
    found: dict[tuple[str, str], dict[int, Module]] = defaultdict(dict)
    for module in modules.by_main.values():
        found[module.package, module.name][id(module)] = module
    for module in modules.by_class.values():
        for key in _programs(module, modules, references):
            found[key][id(module)] = module
    return {key: tuple(entries.values()) for key, entries in found.items()}


def _programs(module: Module, modules: Modules, references: References) -> Iterator[tuple[str, str]]:
    """Yield the executables in which a module class is made, directly or through other classes."""
    assert module.cls is not None
    named = modules.registry.names.get(id(module.cls))
    if named is not None:
        yield module.package, named
    seen, pending = {id(module.cls)}, list(references.makers(module.cls))
    while pending and len(seen) < MAX_USERS:
        unit = pending.pop()
        if id(unit) in seen:
            continue
        seen.add(id(unit))
        program = modules.registry.programs.get(id(unit))
        if program is not None:
            yield unit.file.package, program
        pending.extend(_users(unit, modules, references))


def _users(unit: Unit, modules: Modules, references: References) -> Iterable[Unit]:
    """Who derives from a module is another module; what it makes is made in it all the same."""
    if isinstance(unit, Cls) and modules.is_module(unit):
        return references.makers(unit)
    return references.users(unit)
