"""LNT065: a launch file in Python tests a launch argument as an object, or its text as a truth value."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Finding
from ecm_parsers.launch.doubts import OBJECT_TESTED, TEXT_TESTED

from ecm_extract.lint.launch_problems import told
from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT065",
    name="launch_object_tested",
    dimension="versioning",
    severity="error",
    who="config",
    consequence="the same side is taken whatever the argument is",
    resolution="compare the text that perform(context) gives with a text, in an OpaqueFunction; or use a condition",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report each test that comes out the same whatever the launch is given."""
    for code in (OBJECT_TESTED, TEXT_TESTED):
        yield from told(RULE, code, workspace)
