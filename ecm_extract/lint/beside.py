"""What runs of packages that are known by their documents, beside the packages under lint.

Their lines are of another tree: they are marked, so that none is taken for a line of the tree under lint.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping, Set
from functools import cached_property, partial
from typing import NamedTuple

import msgspec
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from ecm_checker.hub.requirement import Requirement
from ecm_checker.hub.running import Running, RunningModule

from ecm_extract.report.places import FOREIGN, is_foreign
from ecm_extract.test_code import is_test_package
from ecm_extract.tree import Tree


class Lines:
    """Where lines that documents tell of lie: in the tree under lint where it has the very file, else in another tree.

    A node may have lines in files of other packages, as in a library that it links.

    Args:
        tree: under lint. roots: the folders of its packages by name.
        documents: that lie beside it, those of its own packages among them.
    """

    def __init__(self, tree: Tree, roots: Mapping[str, str], documents: Iterable[Package]) -> None:
        self._tree = tree
        owners: dict[str, list[Package]] = defaultdict(list)
        for each in documents:
            for path in filter(each.holds, each.files):
                owners[path].append(each)
        own = {path: found[0] for path, found in owners.items() if len(found) == 1 and found[0].name in roots}
        self._own = {
            path: _At(f"{roots[each.name]}/{each.inside(path)}".lstrip("/"), each) for path, each in own.items()
        }

    def of(self, package: str, path: str) -> str:
        """Return the path of a file that the document of a package names; one of another tree is marked."""
        at = self._own.get(path)
        is_same = at is not None and at.path in self._paths and self._tree.identity(at.path) == at.package.files[path]
        return at.path if at is not None and is_same else f"{FOREIGN}{package}/{path}"

    @cached_property
    def _paths(self) -> frozenset[str]:
        return frozenset(entry.path for entry in self._tree.files())


class _At(NamedTuple):
    """A file of the tree under lint, and the document of its package."""

    path: str
    package: Package


def running_beside(documents: Iterable[Package], lines: Lines) -> Mapping[str, Running]:
    """Return what runs of each package whose document tells it, with lines of other trees marked."""
    return {each.name: _placed(each.running, partial(lines.of, each.name)) for each in documents if each.running}


def own_running(own: Mapping[str, Running], beside: Mapping[str, Running]) -> Mapping[str, Running]:
    """Return what runs of the tree: what of a library runs in programs of documents is no module by itself."""
    told = {(at.path, at.line) for running in beside.values() for each in running.modules for at in each.endpoints}
    return {name: _without(running, told) for name, running in own.items()} if told else own


def _without(running: Running, told: Set[tuple[str, int]]) -> Running:
    modules = tuple(
        msgspec.structs.replace(each, endpoints=tuple(at for at in each.endpoints if (at.path, at.line) not in told))
        if not each.is_program and not each.cls
        else each
        for each in running.modules
    )
    return msgspec.structs.replace(running, modules=modules)


def foreign_requirements(documents: Iterable[Package], own: frozenset[str]) -> Iterator[tuple[str, Requirement]]:
    """Yield what packages require that only documents tell of, by name of the package, with marked lines."""
    for package in documents:
        if package.name not in own:
            yield from ((package.name, _marked_lines(package.name, each)) for each in package.requires)


def _marked_lines(package: str, requirement: Requirement) -> Requirement:
    lines = (msgspec.structs.replace(at, path=f"{FOREIGN}{package}/{at.path}") for at in requirement.evidence)
    return msgspec.structs.replace(requirement, evidence=tuple(lines))


def tests_named(documents: Iterable[Package], roots: Mapping[str, str]) -> Iterator[str]:
    """Yield the packages under lint that are for tests by their folder, which only their documents tell.

    Args:
        documents: of all packages.
        roots: the folders of the packages under lint by name, as their tree gives them.
    """
    named = (each for each in documents if roots.get(each.name) == "")
    return (each.name for each in named if is_test_package(each.path))


def of_tree(findings: Iterable[Finding]) -> Iterator[Finding]:
    """Yield findings that the tree under lint causes, those whose first line is its own."""
    return (each for each in findings if not any(map(is_foreign, each.evidence[:1])))


def _placed(running: Running, place: Callable[[str], str]) -> Running:
    return msgspec.structs.replace(running, modules=tuple(_module(each, place) for each in running.modules), texts={})


def _module(module: RunningModule, place: Callable[[str], str]) -> RunningModule:
    endpoints = tuple(msgspec.structs.replace(each, path=place(each.path)) for each in module.endpoints)
    return msgspec.structs.replace(module, path=place(module.path), endpoints=endpoints)
