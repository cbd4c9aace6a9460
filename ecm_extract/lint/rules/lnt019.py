"""LNT019: a change removes, renames or retypes something that others can depend on. Made by `lint --base` only."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_checker.finding import Finding

from ecm_extract.lint.rule import LintRule

if TYPE_CHECKING:
    from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT019",
    name="interface_changed",
    dimension="versioning",
    severity="warning",
    who="graph",
    consequence="whoever uses it breaks with the next release, mostly without an error",
    resolution="keep the old name for a release with a deprecation, or write migration notes and raise the version",
    tier="stable",  # what diff says, on request: its figures are those of benchmarks/diff_precision
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Yield nothing: a workspace alone shows no change; see `ecm_extract.lint.base`."""
    yield from ()
