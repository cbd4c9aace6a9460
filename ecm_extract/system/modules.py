"""Which contracts an instance has: by its executable, by the class of its component or nodelet, by its plugins."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from ecm_extract.link.composition import Composition, Part
from ecm_extract.link.linker import LinkedModule
from ecm_extract.link.modules import Module
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.model import Instance

MAX_PARTS = 200
_TEMPLATE = re.compile(r"<([\w:\s]+)>")


class Loaded(NamedTuple):
    """A module that an instance runs.

    `name` is what its maker calls its node, `nested` tells that the node is in a namespace of that name, `lookup` is
    the name of a plugin that is loaded because it is declared.
    """

    module: LinkedModule
    name: str | None = None
    nested: bool = False
    lookup: str | None = None


class ModuleIndex:
    """Looks up the modules of a tree as loaders and launchers name them."""

    def __init__(
        self, linked: Iterable[LinkedModule], packages: Iterable[PackageFacts], composition: Composition
    ) -> None:
        self._linked = {id(entry.module): entry for entry in linked}
        self._composition = composition
        self._classes = {
            entry.module.cls.qualified: entry for entry in self._linked.values() if entry.module.cls is not None
        }
        self._bases: dict[str, str] = {}
        self._plugins = self._by_lookup_name(packages)

    def _by_lookup_name(self, packages: Iterable[PackageFacts]) -> Mapping[str, LinkedModule]:
        found = {}
        for package in packages:
            for classes in package.plugins.values():
                for entry in classes:
                    inner = _TEMPLATE.search(entry.type)
                    module = self._class(inner[1]) if inner is not None else self._class(entry.type)
                    if module is not None:
                        found[entry.lookup_name] = module
                        self._bases[entry.lookup_name] = entry.base_class_type
        return found

    def of(self, instance: Instance) -> Sequence[Loaded]:
        """Return the modules that an instance runs, its own first; none when its code is outside the tree."""
        if instance.plugin:
            module = self.plugin(instance.plugin)
            return [] if module is None else self._with_parts([Loaded(module)])
        name = instance.executable
        for key in (name, name.removesuffix(".py"), name.rsplit("/", 1)[-1]):
            found = self._loaded(self._composition.programs.get((instance.package, key), ()))
            if found:
                return self._with_parts(sorted(found, key=lambda entry: _rank(entry.module, key)))
        return []

    def _loaded(self, parts: Iterable[Part]) -> list[Loaded]:
        return [
            Loaded(self._linked[id(part.module)], part.name, part.nested)
            for part in parts
            if id(part.module) in self._linked
        ]

    def _with_parts(self, found: list[Loaded]) -> list[Loaded]:
        """Add the nodes that modules make inside themselves."""
        result = list(found)
        for entry in result:
            module = entry.module.module
            for part in [*self._loaded(self._composition.parts.get(id(module), ())), *self._all_plugins(module)]:
                if len(result) < MAX_PARTS and part not in result:
                    result.append(part)
        return result

    def _all_plugins(self, module: Module) -> list[Loaded]:
        """Every plugin of the bases that a module loads all classes of, by its lookup name."""
        bases = {base.rpartition("::")[2] for base in self._composition.loads.get(id(module), ())}
        return [
            Loaded(self._plugins[name], lookup=name)
            for name, base in sorted(self._bases.items())
            if base.rpartition("::")[2] in bases
        ]

    def plugin(self, name: str) -> LinkedModule | None:
        """Return the module of a class by its lookup name or its qualified name."""
        return self._plugins.get(name) or self._class(name)

    def _class(self, name: str) -> LinkedModule | None:
        bare = name.replace("/", "::").removeprefix("::")
        return self._classes.get(bare)


def _rank(entry: LinkedModule, executable: str) -> tuple[int, str]:
    """The module that the program is named after comes first, a module with endpoints before one without."""
    module = entry.module
    own = module.name == executable or module.main is not None
    return (0 if own and entry.interfaces else 1 if entry.interfaces else 2, module.name)
