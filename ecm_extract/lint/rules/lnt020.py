"""LNT020: source includes or imports a package that package.xml does not name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from types import MappingProxyType
from typing import NamedTuple

from ecm_checker.contract import Evidence
from ecm_checker.finding import Depend, Entity, Finding

from ecm_extract.link.code.units import File
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped

RULE = LintRule(
    id="LNT020",
    name="source_dependency_undeclared",
    dimension="versioning",
    severity="info",
    who="source",
    consequence="on a machine that has only what package.xml asks for, it does not build or import",
    resolution="add a <depend>, <build_depend> or <exec_depend> to package.xml",
)


_INTERFACES = ("_msgs", "std_srvs")


class _Others(NamedTuple):
    """What is known of packages: their names, and whose a header is that does not begin with its package."""

    names: frozenset[str]
    homes: Mapping[str, str]


@cache
def python_packages() -> Mapping[str, str]:
    """Return the package of widely used Python modules."""
    return MappingProxyType(shipped("lint/python_packages.toml")["packages"])


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each package once for the package that uses it."""
    files: dict[str, list[File]] = {}
    for file in workspace.linker.program.files:
        files.setdefault(file.package, []).append(file)
    others = _Others(frozenset(workspace.by_name) | {each.name for each in workspace.others}, _homes(workspace))
    for package in workspace.packages:
        if package.manifest is None or package.root.rosbuild:
            continue
        declared = {entry.name for entry in package.manifest.dependencies} | {package.name} | workspace.externals
        for name, lines in _used(files.get(package.name, []), package, others).items():
            if name not in declared and name.replace("python3-", "python-") not in declared:
                text = f"{package.name} uses {name}, which its package.xml does not name"
                entity, edit = Entity("package", name), Depend(name, "build")
                yield RULE.finding(text, entity, package.name, lines[:5], edit=edit)


def _homes(workspace: Workspace) -> dict[str, str]:
    """Return the package of each installed header whose path does not begin with its package, by what includes say."""
    found: dict[str, set[str]] = {}
    for package, path in _sources(workspace):
        inside = path.rpartition("/include/")[2] if "/include/" in path else ""
        for written in (inside, inside.removeprefix(f"{package}/")):
            if "/" in written and written.partition("/")[0] != package:
                found.setdefault(written, set()).add(package)
    return {written: next(iter(names)) for written, names in found.items() if len(names) == 1}


def _sources(workspace: Workspace) -> Iterator[tuple[str, str]]:
    """Yield each package with its files; of one that is known by its document those that the document lists."""
    for package in workspace.packages:
        yield from ((package.name, path) for path in package.sources)
    for document in workspace.others:
        if document.name not in workspace.by_name:
            yield from ((document.name, path) for path in document.files)


def _used(files: list[File], package: PackageFacts, others: _Others) -> dict[str, list[Evidence]]:
    own = {
        entry.path.rsplit("/", 1)[-1].removesuffix(".py") for entry in package.root.files if entry.path.endswith(".py")
    }
    built = {entry.name for cmake in package.cmake.values() for entry in cmake.dependencies}
    found: dict[str, list[Evidence]] = {}
    for file in files:
        for entry in file.facts.imports:
            name = (
                _python(entry.module, own, others)
                if file.language == "python"
                else others.homes.get(entry.module) or _cpp(entry.module, built, others)
            )
            if name is not None:
                found.setdefault(name, []).append(Evidence(file.path, entry.line))
    return found


def _python(module: str, own: set[str], others: _Others) -> str | None:
    top = module.split(".")[0]
    if not top or top in own:
        return None
    if top in others.names or top.endswith(_INTERFACES):
        return top
    return python_packages().get(top)


def _cpp(path: str, built: set[str], others: _Others) -> str | None:
    """The first folder of an include is its package, when that is in the tree, holds messages, or is found by CMake."""
    top, slash, _ = path.partition("/")
    known = top in others.names or top.endswith(_INTERFACES) or (top in built and top.islower())
    return top if slash and known else None
