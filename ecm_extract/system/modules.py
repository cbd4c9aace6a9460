"""Which contracts an instance has: by its executable, by the class of its component or nodelet, by its plugins."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from ecm_extract.link.composition import Composition, Part
from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.model import Instance

MAX_PARTS = 50


class Loaded(NamedTuple):
    """A module that an instance runs: the name that its maker gives its node, and whether it has its own namespace."""

    module: LinkedModule
    name: str | None = None
    nested: bool = False


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
        self._plugins = self._by_lookup_name(packages)

    def _by_lookup_name(self, packages: Iterable[PackageFacts]) -> Mapping[str, LinkedModule]:
        found = {}
        for package in packages:
            for classes in package.plugins.values():
                for entry in classes:
                    module = self._class(entry.type)
                    if module is not None:
                        found[entry.lookup_name] = module
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
            for part in self._loaded(self._composition.parts.get(id(entry.module.module), ())):
                if len(result) < MAX_PARTS and part not in result:
                    result.append(part)
        return result

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
