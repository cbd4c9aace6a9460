"""Which contracts an instance has: by its executable, by the class of its component or nodelet, by its plugins."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple

from ecm_checker.hub.running import Part, Running, RunningModule

from ecm_extract.system.model import Instance
from ecm_extract.system.older_plugins import renewed

MAX_PARTS = 200


class Loaded(NamedTuple):
    """A module that an instance runs.

    `name` is what its maker calls its node, `nested` tells that the node is in a namespace of that name, `lookup` is
    the name of a plugin that is loaded because it is declared.
    """

    module: RunningModule
    name: str | None = None
    nested: bool = False
    lookup: str | None = None


class ModuleIndex:
    """Looks up modules as loaders and launchers name them.

    Args:
        packages: what runs of each package, in the order of their folders.
    """

    def __init__(self, packages: Mapping[str, Running]) -> None:
        self._packages = packages = renewed(packages)
        self._classes = {
            module.cls: module for running in packages.values() for module in running.modules if module.cls
        }
        self._bases: dict[str, str] = {}
        self._plugins = dict(self._by_lookup_name())

    @property
    def modules(self) -> Iterator[RunningModule]:
        """All modules, package by package."""
        return (module for running in self._packages.values() for module in running.modules)

    def _by_lookup_name(self) -> Iterator[tuple[str, RunningModule]]:
        for running in self._packages.values():
            for entry in running.plugins:
                module = self._class(entry.cls)
                if module is not None:
                    self._bases[entry.lookup] = entry.base
                    yield entry.lookup, module

    def of(self, instance: Instance) -> Sequence[Loaded]:
        """Return the modules that an instance runs, its own first; none when its code is outside the tree."""
        if instance.plugin:
            module = self.plugin(instance.plugin)
            return [] if module is None else self._with_parts([Loaded(module)])
        running = self._packages.get(instance.package, Running())
        name = instance.executable
        for key in (name, name.removesuffix(".py"), name.rsplit("/", 1)[-1]):
            found = self._loaded(running.programs.get(key, ()))
            if found:
                return self._with_parts(sorted(found, key=lambda entry: _rank(entry.module, key)))
        return []

    def _loaded(self, parts: Iterable[Part]) -> list[Loaded]:
        known = (part for part in parts if part.package in self._packages)
        return [Loaded(self._packages[part.package].modules[part.at], part.name, part.nested) for part in known]

    def _with_parts(self, found: list[Loaded]) -> list[Loaded]:
        """Add the nodes that modules make inside themselves."""
        result = list(found)
        for entry in result:
            for part in [*self._loaded(entry.module.parts), *self._all_plugins(entry.module)]:
                if len(result) < MAX_PARTS and part not in result:
                    result.append(part)
        return result

    def _all_plugins(self, module: RunningModule) -> list[Loaded]:
        """Every plugin of the bases that a module loads all classes of, by its lookup name."""
        bases = {base.rpartition("::")[2] for base in module.loads}
        return [
            Loaded(self._plugins[name], lookup=name)
            for name, base in sorted(self._bases.items())
            if base.rpartition("::")[2] in bases
        ]

    def plugin(self, name: str) -> RunningModule | None:
        """Return the module of a class by its lookup name or its qualified name."""
        return self._plugins.get(name) or self._class(name)

    def _class(self, name: str) -> RunningModule | None:
        bare = name.replace("/", "::").removeprefix("::")
        return self._classes.get(bare)


def _rank(module: RunningModule, executable: str) -> tuple[int, str]:
    """The module that the program is named after comes first, a module with endpoints before one without."""
    own = module.name == executable or module.is_program
    return (0 if own and module.endpoints else 1 if module.endpoints else 2, module.name)
