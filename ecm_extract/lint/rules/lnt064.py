"""LNT064: a launch file has a value that the launch cannot work out, or that ROS does not take."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding
from ecm_parsers.launch.model import LaunchFile

from ecm_extract.entities.launch_values import is_judged
from ecm_extract.lint.launch_names import invalid_names
from ecm_extract.lint.launch_unset import Unset, Unsettled
from ecm_extract.lint.refused_values import is_left_behind
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT064",
    name="launch_value_refused",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="the launch stops there, or goes on with a text that nobody meant",
    resolution="correct the value",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each such value once for a file."""
    unsettled = Unsettled(workspace.launches)
    for package in workspace.packages:
        for entry in package.root.files:
            path = entry.path
            file = workspace.launches.get(path)
            if file is None or not is_judged(path) or is_left_behind(file, package.ros):
                continue
            lines: dict[str, list[Unset]] = defaultdict(list)
            for each in (*unsettled.of(path), *_named(file)):
                lines[each.wrong].append(each)
            for wrong, places in lines.items():
                yield RULE.finding(
                    f"{path}: {wrong}",
                    Entity("launch_file", workspace.in_package(path), wrong),
                    package.name,
                    [Evidence(path, each.line) for each in places],
                    certainty="proved" if any(each.is_sure for each in places) else "likely",
                )


def _named(file: LaunchFile) -> Iterator[Unset]:
    for line, wrong in invalid_names(file):
        yield Unset(line, wrong)
