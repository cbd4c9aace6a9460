"""Which parameter files of a tree configure a controller."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable

from ecm_parsers.controllers_yaml import Controller

from ecm_extract.link.linker import LinkedModule
from ecm_extract.read.facts import PackageFacts


class ControllerSettings:
    """Looks up configured controllers by their class."""

    def __init__(self, packages: Iterable[PackageFacts]) -> None:
        self._by_type: dict[str, list[tuple[str, Controller]]] = defaultdict(list)
        names: dict[str, str] = {}
        for package in packages:
            for classes in package.plugins.values():
                names |= {entry.type: entry.lookup_name for entry in classes}
            for path, file in sorted(package.controllers.items()):
                for controller in file.controllers:
                    if controller.type:
                        self._by_type[controller.type].append((path, controller))
        self._lookup_names = names

    def of(self, entry: LinkedModule) -> list[tuple[str, Controller]]:
        """Return (path, section) of every configuration of a module."""
        cls = entry.module.cls
        lookup = self._lookup_names.get(cls.qualified) if cls is not None else None
        return self._by_type.get(lookup, []) if lookup is not None else []
