"""LNT063: a launch file in Python builds its description and does not return it."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace
from ecm_extract.test_code import is_test_path

RULE = LintRule(
    id="LNT063",
    name="launch_returns_nothing",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="ros2 launch stops as soon as it loads the file, and so does every launch that includes it",
    resolution="return the LaunchDescription at the end of the function",
)
_CODE = "launch-returns-nothing"


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each launch file whose function ends without a value."""
    for package in workspace.packages:
        for entry in package.root.files:
            if entry.path.endswith("launch.py") and not is_test_path(entry.path, package.root.path):
                for problem in workspace.launch_problems.get(entry.path, ()):
                    if problem.code == _CODE:
                        text = f"generate_launch_description of {entry.path} returns nothing"
                        lines = [Evidence(entry.path, problem.line)]
                        entity = Entity("launch_file", workspace.in_package(entry.path))
                        yield RULE.finding(text, entity, package.name, lines)
