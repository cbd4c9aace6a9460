"""LNT018: an overlay declares something that the source contradicts."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT018",
    name="contract_drift",
    dimension="versioning",
    severity="warning",
    who="safety",
    consequence="whoever decides by the contract decides by something that is no longer so",
    resolution="correct the overlay, or the source",
    tier="stable",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report the contradictions between each `ecm.yaml` and what was read."""
    workspace.assemble()
    for entry in workspace.diagnostics("drift"):
        package = workspace.package_of(entry.path)
        evidence = [Evidence(entry.path, entry.line)]
        yield RULE.finding(entry.message.rstrip("."), Entity("contract", entry.about), package, evidence)
