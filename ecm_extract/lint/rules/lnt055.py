"""LNT055: package.xml names a dependency that no distribution and no key of rosdep has."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity
from ecm_parsers.package_facts import Dependency

from ecm_extract.lint.fetched import fetched_repositories
from ecm_extract.lint.known_packages import known_packages
from ecm_extract.lint.near import nearest
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT055",
    name="dependency_unknown",
    dimension="versioning",
    severity="warning",
    who="config",
    consequence="rosdep and the build farm stop: they cannot tell what to install",
    resolution="correct the name, remove it, or name it under externals in ecm.toml",
)
_NEAR: Final = 0.93
_LONG: Final = 9
"""Shorter names are alike by chance."""

_NO_PACKAGE: Final = frozenset({"group_depend", "member_of_group", "conflict", "replace"})
"""Elements that do not ask for a package."""


_VENDOR: Final = re.compile(r"(?:lib)?(?:ignition|gz|sdformat|gazebo)(?:-[a-z]+)*-?\d+(?:-dev)?")
"""Keys of the list of Gazebo's makers (github.com/osrf/osrf-rosdep), where each major version has its own."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each name once for a package; what holds under a condition only is left alone."""
    own = frozenset(workspace.by_name) | workspace.externals | fetched_repositories(workspace.tree)
    for package in workspace.packages:
        asked = package.manifest.dependencies if package.manifest is not None and not package.root.rosbuild else ()
        first = {entry.name: entry for entry in reversed(asked) if entry.kind not in _NO_PACKAGE}
        for name, entry in sorted(first.items()):
            if name not in own and entry.condition is None and _VENDOR.fullmatch(name) is None:
                yield from _of(entry, package, frozenset(workspace.by_name))


def _of(entry: Dependency, package: PackageFacts, own: frozenset[str]) -> Iterator[Finding]:
    where = known_packages().get(entry.name)
    if where is not None and not _is_of_other_ros(where, package):
        return
    level: Severity = "warning"
    if where is not None:
        if any(entry.name == each.name for file in package.cmake.values() for each in file.dependencies):
            level = "info"  # its build finds it: somebody has it from source
        if package.ros == 1:
            level = "info"  # what is released for ROS 2 now may have been there before, unreleased
        text = f"{package.name} asks for {entry.name}, which was released for ROS {where} only"
    else:
        near = _meant(entry.name, package, own)
        text = f"{package.name} asks for {entry.name}, which no distribution and no key of rosdep has"
        text += f"; {near[1]} {near[0]}" if near else ""
        level = "error" if near else "info"
        alike = None if near else nearest(entry.name, _alike(entry.name), _NEAR)
        text += f"; released is {alike}" if alike else ""
    evidence = [Evidence(package.root.manifest or "", entry.line)]
    yield RULE.finding(text, Entity("package", entry.name), package.name, evidence, severity=level)


def _alike(name: str) -> list[str]:
    return [other for other in known_packages() if other[:1] == name[:1]] if len(name) >= _LONG else []


def _meant(name: str, package: PackageFacts, own: frozenset[str]) -> tuple[str, str] | None:
    """The name that a typing error made this one of, and who has it.

    Only what the build of the package finds, or the workspace holds, is meant: among ten thousand names of released
    packages some are alike by chance.
    """
    found = {entry.name for file in package.cmake.values() for entry in file.dependencies}
    if len(name) < _LONG or name in found:
        return None
    for names, words in ((found & known_packages().keys(), "its CMakeLists.txt finds"), (own, "the workspace has")):
        near = nearest(name, names - {package.name}, _NEAR)
        if near is not None:
            return near, words
    return None


def _is_of_other_ros(where: str, package: PackageFacts) -> bool:
    return where in {"1", "2"} and package.ros is not None and where != str(package.ros)
