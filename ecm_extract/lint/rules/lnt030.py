"""LNT030: a package raises its version by less than its changes need. Made by `lint --base` only."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_checker.finding import Finding

from ecm_extract.lint.rule import LintRule

if TYPE_CHECKING:
    from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT030",
    name="version_bump_too_small",
    dimension="versioning",
    severity="warning",
    who="source",
    consequence="who asked for a compatible version gets one that breaks them",
    resolution="raise the version as far as the changes need, or take the breaking change back",
    tier="stable",  # what diff says, on request: its figures are those of benchmarks/diff_precision
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Yield nothing: a workspace alone shows no change; see `ecm_extract.lint.base`."""
    yield from ()
