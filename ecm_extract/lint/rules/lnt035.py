"""LNT035: package.xml names a package that no file of the package uses."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Set

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.package_facts import Dependency

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.source_suffixes import is_included

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
)
"""Suffixes of files that can use a package; lists in CMakeLists.txt and prose are no use."""
_GENERATORS = re.compile(r"gener|cmake|_runtime$|_default_|_common$|^ament|^rosidl|^catkin|^ros_|^roslaunch$")
_INCLUDE = re.compile(rb"#\s*include\s*[<\"]([^>\"\n]+/[^>\"\n]+)[>\"]")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report packages of the tree, of documents beside it, and of messages that are asked for to build and not used."""
    headers = {document.name: _headers(document.files) for document in workspace.stored}
    headers |= {package.name: _headers(package.sources) for package in workspace.packages}
    for package in workspace.packages:
        manifest = package.manifest
        if manifest is None or package.root.rosbuild or any(entry.tag == "metapackage" for entry in manifest.exports):
            continue
        asked = {entry.name: entry for entry in reversed(manifest.dependencies) if _is_judged(entry, headers.keys())}
        if asked and _has_sources(package):
            for name in sorted(asked.keys() - _used(workspace, package, set(asked), headers)):
                text = f"{package.name} depends on {name} and uses nothing of it"
                evidence = [Evidence(package.root.manifest or "", asked[name].line)]
                yield RULE.finding(text, Entity("package", name), package.name, evidence, certainty="likely")


def _is_judged(entry: Dependency, shown: Set[str]) -> bool:
    """A package of the tree or of a document shows what it offers, a message package has its name in every use."""
    known = entry.name in shown or entry.name.endswith("_msgs")
    return entry.kind in _KINDS and known and _GENERATORS.search(entry.name) is None


def _has_sources(package: PackageFacts) -> bool:
    return bool(package.sources or package.interfaces)


def _headers(paths: Iterable[str]) -> tuple[str, ...]:
    return tuple(path for path in paths if is_included(path))


def _used(
    workspace: Workspace, package: PackageFacts, names: set[str], headers: dict[str, tuple[str, ...]]
) -> set[str]:
    """Names that stand in any file, tests and comments too, and packages that a header comes from."""
    found: set[str] = {"actionlib_msgs", "action_msgs"} if _has_actions(package) else set()
    words = re.compile(rb"\b(" + b"|".join(re.escape(name.encode()) for name in sorted(names)) + rb")\b")
    included: set[str] = set()
    for _, data in workspace.tree.read_many(list(_read(package))):
        found |= {match.decode() for match in words.findall(data)}
        included |= {f"/{match.decode('utf-8', 'replace')}" for match in _INCLUDE.findall(data)}
    ends = tuple(included)
    return found | {name for name in names if any(f"/{path}".endswith(ends) for path in headers.get(name, ()))}


def _read(package: PackageFacts) -> Iterator[str]:
    for entry in package.root.files:
        suffix = entry.path.rpartition("/")[2].partition(".")[2].rpartition(".")[2]
        if entry.path != package.root.manifest and suffix in _READ:
            yield entry.path


def _has_actions(package: PackageFacts) -> bool:
    return any(definition.shape == "action" for definition in package.interfaces.values())
