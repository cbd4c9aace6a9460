"""LNT061: a launch file, description, package.xml or CMakeLists.txt is not well-formed, or has a refused value."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.refused import XML, refusal
from ecm_extract.lint.refused_values import refused_values
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.test_code import is_test_path

RULE = LintRule(
    id="LNT061",
    name="file_not_well_formed",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="whoever reads the file stops there with an error: roslaunch, xacro, CMake or the build tool",
    resolution="correct the line, and escape & as &amp; and < as &lt; in XML",
    tier="stable",
)


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
        for entry in package.root.files:
            path = entry.path
            if is_test_path(path, package.root.path) or "template" in path.lower():
                continue
            if not f"/{path}".endswith((*XML, "/CMakeLists.txt")):
                continue
            problem = refusal(path, workspace)
            if problem is not None:
                entity = Entity("file", workspace.in_package(path))
                text = f"{path} is not well-formed ({problem.wrong or problem.message.rstrip('.')})"
                yield RULE.finding(text, entity, package.name, [Evidence(path, problem.line)], certainty="proved")
