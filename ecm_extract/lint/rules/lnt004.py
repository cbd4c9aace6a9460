"""LNT004: a launch file or description uses a package that package.xml does not name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.discover import is_test_path
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

RULE = LintRule(
    id="LNT004",
    name="dependency_undeclared",
    dimension="versioning",
    severity="info",
    who="config",
    consequence="on a machine that has only what package.xml asks for, the launch stops with 'package not found'",
    resolution="add an <exec_depend> (<run_depend> in format 1) to package.xml",
)
_USED = re.compile(
    rb"""\$\(find(?:-pkg-share|-pkg-prefix)?\s+(\w+)\s*\)|package://(\w+)/"""
    rb"""|(?:FindPackageShare|get_package_share_directory|get_package_share_path)\(\s*['"](\w+)['"]"""
    rb"""|\bpkg\s*=\s*"(\w+)"|\bpackage\s*=\s*['"](\w+)['"]|\bargs\s*=\s*"\s*(?:load|standalone)\s+(\w+)/\w"""
)
_FILES = (".launch", ".launch.xml", ".launch.py", "_launch.py", ".xacro", ".urdf", ".launch.yaml")


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each package once for the package that uses it, with its first lines."""
    for package in workspace.packages:
        if package.manifest is None:
            continue
        declared = {entry.name for entry in package.manifest.dependencies} | {package.name} | workspace.externals
        for name, lines in _used(workspace, package).items():
            if name not in declared:
                text = f"{package.name} uses {name}, which its package.xml does not name"
                yield RULE.finding(text, Entity("package", name), package.name, lines[:5])


def _used(workspace: Workspace, package: PackageFacts) -> dict[str, list[Evidence]]:
    found: dict[str, list[Evidence]] = {}
    for entry in package.root.files:
        if not entry.path.endswith(_FILES) or is_test_path(entry.path, package.root.path):
            continue
        data = workspace.files.read(entry.path) or b""
        for match in _USED.finditer(data):
            name = next(part for part in match.groups() if part).decode()
            line = data.count(b"\n", 0, match.start()) + 1
            found.setdefault(name, []).append(Evidence(entry.path, line))
    return found
