"""LNT066: a launch file in Python makes an action that nothing takes."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Finding
from ecm_parsers.launch.lost import REPLACED, UNUSED

from ecm_extract.lint.launch_problems import told
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT066",
    name="launch_action_lost",
    dimension="versioning",
    severity="warning",
    who="config",
    consequence="it is never started",
    resolution="give the action a name of its own and add it to the description, or remove it",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report actions that are replaced before anything takes them; those that stay aside are an info."""
    yield from told(RULE, REPLACED, workspace)
    yield from told(RULE, UNUSED, workspace, severity="info")
