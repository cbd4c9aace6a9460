"""LNT061: the reader of a file refuses it: XML, CMake, Python, YAML, a manifest, or a value of a launch file."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding, Severity

from ecm_extract.lint.installed_files import is_in_use
from ecm_extract.lint.refused import refusal
from ecm_extract.lint.refused_values import refused_values
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.system.launch_files import is_launch_file
from ecm_extract.test_code import is_in_test_folder, is_test_path

RULE = LintRule(
    id="LNT061",
    name="file_not_well_formed",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="whoever reads the file stops there with an error: roslaunch, xacro, Python, rosparam or the build",
    resolution="correct the line, and escape & as &amp; and < as &lt; in XML",
    tier="stable",
)
_YAML = (".yaml", ".yml")
"""Read by nodes, and by rosparam, where the package is one of ROS."""


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report the first problem of each file that a strict reader refuses, and values that launch refuses."""
    yield from _malformed(workspace)
    for package in workspace.packages:
        for entry in package.root.files:
            for wrong, places in refused_values(entry.path, package.ros, workspace).items():
                yield RULE.finding(
                    f"{entry.path}: {wrong}",
                    Entity("launch_file", workspace.in_package(entry.path), wrong),
                    package.name,
                    [Evidence(entry.path, each.line) for each in places],
                    certainty="proved" if any(each.is_sure for each in places) else "likely",
                    consequence="the launch stops there, or goes on with a text that nobody meant",
                    resolution="correct the substitution or the condition",
                )


def _malformed(workspace: Workspace) -> Iterator[Finding]:
    for package in workspace.packages:
        for path in filter(lambda each: _is_read(each, package), _paths(package)):
            problem = refusal(path, workspace)
            if problem is not None:
                entity = Entity("file", workspace.in_package(path))
                text = f"{path} is refused by its reader ({problem.wrong or problem.message.rstrip('.')})"
                level: Severity | None = None if _is_used(path, package, workspace) else "info"
                yield RULE.finding(text, entity, package.name, [Evidence(path, problem.line)], severity=level)


def _paths(package: PackageFacts) -> Iterator[str]:
    return (entry.path for entry in package.root.files)


def _is_read(path: str, package: PackageFacts) -> bool:
    """No test, no template, no hidden copy, and of Python what the package runs or is built with."""
    if is_test_path(path, package.root.path) or is_in_test_folder(path) or "template" in path.lower():
        return False
    if path.endswith(_YAML) and package.ros is None:
        return False
    if path.endswith(".py") and path not in package.sources:
        return is_launch_file(path) or path.rpartition("/")[2] == "setup.py"
    return "/." not in f"/{path}"


def _is_used(path: str, package: PackageFacts, workspace: Workspace) -> bool:
    """Launch files run, and so does what ROS 1 finds in the folder of a package; ROS 2 runs what is installed."""
    if not path.endswith(".py") or package.ros != 2 or is_launch_file(path) or path.endswith("setup.py"):
        return True
    return is_in_use(path, package, workspace.packages)
