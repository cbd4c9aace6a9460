"""What runs of packages that are known by their documents, beside the packages under lint.

Their lines are of another tree: they are marked, so that none is taken for a line of the tree under lint.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.running import Running, RunningModule

from ecm_extract.report.places import FOREIGN, is_foreign


def running_beside(documents: Iterable[Package]) -> Mapping[str, Running]:
    """Return what runs of each package whose document tells it, with marked lines."""
    return {each.name: _marked(each.running, f"{FOREIGN}{each.name}/") for each in documents if each.running}


def foreign_requirements(documents: Iterable[Package], own: frozenset[str]) -> Iterator[tuple[str, Requirement]]:
    """Yield what packages require that only documents tell of, by name of the package, with marked lines."""
    for package in documents:
        if package.name not in own:
            yield from ((package.name, _marked_lines(package.name, each)) for each in package.requires)


def _marked_lines(package: str, requirement: Requirement) -> Requirement:
    lines = (msgspec.structs.replace(at, path=f"{FOREIGN}{package}/{at.path}") for at in requirement.evidence)
    return msgspec.structs.replace(requirement, evidence=tuple(lines))


def of_tree(findings: Iterable[Finding]) -> Iterator[Finding]:
    """Yield findings that the tree under lint causes, those whose first line is its own."""
    return (each for each in findings if not any(map(is_foreign, each.evidence[:1])))


def _marked(running: Running, mark: str) -> Running:
    return msgspec.structs.replace(running, modules=tuple(_module(each, mark) for each in running.modules), texts={})


def _module(module: RunningModule, mark: str) -> RunningModule:
    endpoints = (msgspec.structs.replace(each, path=f"{mark}{each.path}") for each in module.endpoints)
    return msgspec.structs.replace(module, path=f"{mark}{module.path}", endpoints=tuple(endpoints))
