"""What of each package of a linked tree runs: the rows of its document that launch files are joined with."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Final

from ecm_checker.contract import Interface
from ecm_checker.hub.local_name import LocalName, Parts, shown
from ecm_checker.hub.running import DeclaredPlugin, Part, Running, RunningEndpoint, RunningModule, as_written
from ecm_checker.json_data import json_data

from ecm_extract.link.linker import LinkedModule
from ecm_extract.link.owning.composition import Composition
from ecm_extract.link.owning.composition import Part as Made
from ecm_extract.link.owning.modules import Module
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.installed import copied_paths

_TEMPLATE: Final = re.compile(r"<([\w:\s]+)>")


def running_of(
    packages: Sequence[PackageFacts], linked: Iterable[LinkedModule], composition: Composition
) -> Mapping[str, Running]:
    """Return what runs, by package; without the content of files."""
    by_package: dict[str, list[LinkedModule]] = defaultdict(list)
    for entry in linked:
        by_package[entry.module.package].append(entry)
    rows = _Rows(by_package, composition)
    return {facts.name: rows.of(facts) for facts in packages}


class _Rows:
    """Writes modules as places among those of their package."""

    def __init__(self, by_package: Mapping[str, Sequence[LinkedModule]], composition: Composition) -> None:
        self._by_package = by_package
        self._composition = composition
        self._at = {entry.module: at for entries in by_package.values() for at, entry in enumerate(entries)}
        self._programs: dict[str, dict[str, tuple[Part, ...]]] = defaultdict(dict)
        for (package, executable), parts in sorted(composition.programs.items()):
            self._programs[package][executable] = self._parts(parts)

    def of(self, facts: PackageFacts) -> Running:
        return Running(
            modules=tuple(self._module(entry) for entry in self._by_package.get(facts.name, ())),
            programs=self._programs.get(facts.name, {}),
            plugins=tuple(_plugins(facts)),
            copied=tuple(copied_paths(facts)),
        )

    def _parts(self, parts: Iterable[Made]) -> tuple[Part, ...]:
        known = (part for part in parts if part.module in self._at)
        return tuple(Part(part.module.package, self._at[part.module], part.name, part.nested) for part in known)

    def _module(self, entry: LinkedModule) -> RunningModule:
        module: Module = entry.module
        claims = entry.claims
        return RunningModule(
            package=module.package,
            name=module.name,
            path=module.path,
            line=module.line,
            cls=module.cls.qualified if module.cls is not None else "",
            is_program=module.main is not None,
            node=entry.node,
            lifecycle=entry.lifecycle,
            endpoints=tuple(_endpoint(each, entry) for each in entry.interfaces),
            claims=None if claims is None else tuple(_written(each.name) for each in claims if each.kind == "command"),
            parts=self._parts(self._composition.parts.get(module, ())),
            loads=tuple(sorted(self._composition.loads.get(module, ()))),
        )


def _endpoint(interface: Interface, entry: LinkedModule) -> RunningEndpoint:
    local = entry.local.get((interface.role, interface.name, interface.type), ())
    first = interface.evidence[0]
    return RunningEndpoint(
        role=interface.role,
        name=interface.name,
        path=first.path,
        line=first.line,
        raw=None if interface.raw_name == interface.name else interface.raw_name,
        local=() if _is_told(interface.name, local) else tuple(as_written(name) for name in local),
        type=interface.type,
        qos=interface.qos,
        default=json_data(interface.default),
        frame=interface.frame,
    )


def _is_told(name: str, local: Sequence[LocalName]) -> bool:
    """Tell whether a name in the namespace `/` says all that one for any namespace does."""
    return all(shown(each.parts) == name and not each.space and not _is_open(each.parts) for each in local)


def _is_open(name: Parts) -> bool:
    """Tell whether a node, or what sets and loads it, tells a part of a name."""
    return any(not isinstance(part, str) and part.of not in {"nobody", "caller"} for part in name)


def _written(claim: Parts) -> str | LocalName:
    return as_written(LocalName(claim))


def _plugins(facts: PackageFacts) -> Iterator[DeclaredPlugin]:
    """Of a template the argument is the class that is declared."""
    for classes in facts.plugins.values():
        for entry in classes:
            inner = _TEMPLATE.search(entry.type)
            cls = inner[1] if inner is not None else entry.type
            yield DeclaredPlugin(entry.lookup_name, cls, entry.base_class_type)
