"""LNT035: package.xml names a package that no file of the package uses."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Set
from typing import NamedTuple

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.package import Package

from ecm_extract.lint.build_tools import calls_of, defined_for_cmake, is_build_tool, is_for_cmake, used_by_generated
from ecm_extract.lint.package_words import PackageWords, includes_of
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.rules.lnt021 import is_meta
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import CPP, is_included

RULE = LintRule(
    id="LNT035",
    name="dependency_unused",
    dimension="versioning",
    severity="info",
    who="source",
    consequence="everybody who installs the package installs the other one too, and waits for its builds",
    resolution="remove the dependency from package.xml and CMakeLists.txt",
)
_KINDS = frozenset({"build", "build_export", "depend"})
"""Run-time dependencies are used by names that only the launch knows."""
_READ = frozenset(
    {
        "",
        "h",
        "hh",
        "hpp",
        "hxx",
        "c",
        "cc",
        "cpp",
        "cxx",
        "ipp",
        "tpp",
        "inl",
        "cu",
        "cuh",
        "py",
        "pyx",
        "pyi",
        "sh",
        "js",
    }
    | {
        "msg",
        "srv",
        "action",
        "idl",
        "cfg",
        "yaml",
        "yml",
        "json",
        "toml",
        "xml",
        "launch",
        "test",
        "urdf",
        "xacro",
        "srdf",
    }
    | {"sdf", "world", "rviz", "perspective", "ui", "in", "em", "cmake", "ini", "repos"}
    | {suffix.removeprefix(".") for suffix in CPP}
)
"""Suffixes of files that can use a package; lists in CMakeLists.txt and prose are no use."""
_MESSAGES = "_msgs"
"""How packages of messages are called, as docs.ros.org has it; of one that is not known nothing else tells."""


class _Offer(NamedTuple):
    """What a package has for those that depend on it, as far as its files show it.

    Attributes:
        headers: their paths. commands: of CMake.
        is_shown: whether a use of it must show: not of one that only names others, or whose code of CMake is not kept.
    """

    headers: tuple[str, ...]
    commands: frozenset[str]
    is_shown: bool


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report packages of the tree, of documents beside it, and of messages that are asked for to build and not used."""
    offers = {document.name: _of_document(document, workspace) for document in workspace.stored}
    offers |= {package.name: _of_package(package, workspace) for package in workspace.packages}
    for package in workspace.packages:
        manifest = package.manifest
        if manifest is None or package.root.rosbuild or is_meta(package):
            continue
        needed = (entry for entry in reversed(manifest.dependencies) if entry.kind in _KINDS)
        asked = {entry.name: entry for entry in needed if _is_judged(entry.name, offers)}
        if asked and _has_sources(package):
            for name in sorted(asked.keys() - _used(workspace, package, asked.keys(), offers)):
                text = f"{package.name} depends on {name} and uses nothing of it"
                evidence = [Evidence(package.root.manifest or "", asked[name].line)]
                yield RULE.finding(text, Entity("package", name), package.name, evidence, certainty="likely")


def _of_document(document: Package, workspace: Workspace) -> _Offer:
    is_known = not any(map(is_for_cmake, document.files))
    used = any(path != document.manifest and _can_use(path) for path in document.files)
    return _Offer(
        _headers(document.files), frozenset(), is_known and (used or not _names_others(document.name, workspace))
    )


def _of_package(package: PackageFacts, workspace: Workspace) -> _Offer:
    commands = frozenset(defined_for_cmake(package, workspace))
    used = any(True for _ in _read(package))
    return _Offer(_headers(package.sources), commands, used or not _names_others(package.name, workspace))


def _names_others(package: str, workspace: Workspace) -> bool:
    """Whether a package brings others to those that depend on it; what its own build asks for is none."""
    return not all(map(is_build_tool, workspace.known.needed_by(package)))


def _is_judged(name: str, offers: Mapping[str, _Offer]) -> bool:
    """A package of the tree or of a document shows what it offers, a message package has its name in every use."""
    is_shown = offers[name].is_shown if name in offers else name.endswith(_MESSAGES)
    return is_shown and not is_build_tool(name)


def _has_sources(package: PackageFacts) -> bool:
    return bool(package.sources or package.interfaces)


def _headers(paths: Iterable[str]) -> tuple[str, ...]:
    return tuple(path for path in paths if is_included(path))


def _used(workspace: Workspace, package: PackageFacts, names: Set[str], offers: Mapping[str, _Offer]) -> Set[str]:
    """Names that any file says, tests too, and packages that a header, a command or something generated comes from."""
    found, words = set(used_by_generated(package)), PackageWords(names)
    paths: set[str] = set()
    for path, data in workspace.tree.read_many(list(_read(package))):
        found |= words.of(path, data, package)
        paths |= {f"/{each}" for each in includes_of(path, data, package) if "/" in each}
    ends, called = tuple(paths), calls_of(package, workspace)
    offered = {name: offers[name] for name in names if name in offers}
    found |= {name for name, each in offered.items() if not called.isdisjoint(each.commands)}
    return found | {name for name, each in offered.items() if any(f"/{path}".endswith(ends) for path in each.headers)}


def _read(package: PackageFacts) -> Iterator[str]:
    return (each.path for each in package.root.files if each.path != package.root.manifest and _can_use(each.path))


def _can_use(path: str) -> bool:
    return path.rpartition("/")[2].partition(".")[2].rpartition(".")[2] in _READ
