"""Which classes of its package the bases of a Python class are, by the imports of the modules that name them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

import msgspec
from ecm_parsers.source.facts import Import, SourceFile

_MOST_STEPS: Final = 10
"""Modules that hand a name on to each other."""


class Module(msgspec.Struct, frozen=True):
    """A module with its dotted name; relative imports of a package (`__init__.py`) begin at itself."""

    name: str
    is_package: bool
    source: SourceFile

    def declares(self, name: str) -> bool:
        """Whether a class of that name stands in it."""
        return any(entry.name == name and not entry.scope for entry in self.source.classes)

    def imported(self, name: str) -> str | None:
        """Return the dotted name that an import binds to a name of the module."""
        for entry in self.source.imports:
            if name == (entry.alias or entry.name or entry.module):
                return ".".join(filter(None, (self._module_of(entry), entry.name)))
        return None

    def _module_of(self, entry: Import) -> str:
        rest = entry.module.lstrip(".")
        up = len(entry.module) - len(rest)
        if not up:
            return rest
        parts = self.name.split(".")
        return ".".join([*parts[: len(parts) - up + self.is_package], *filter(None, [rest])])


def class_meant(written: str, module: Module, modules: Mapping[str, Module]) -> str:
    """Return the dotted name of the class that a base means; as it is written where no module of these declares it."""
    first, dot, rest = written.partition(".")
    if module.declares(first):
        return f"{module.name}.{written}"
    target = module.imported(first)
    return _home(f"{target}{dot}{rest}", modules) or written if target is not None else written


def _home(dotted: str, modules: Mapping[str, Module]) -> str | None:
    """The name of a class where it is declared, by whatever modules it is handed on."""
    for _ in range(_MOST_STEPS):
        place, _, name = dotted.rpartition(".")
        module = modules.get(place)
        if module is None:
            return None
        if module.declares(name):
            return dotted
        target = module.imported(name)
        if target is None:
            return None
        dotted = target
    return None
