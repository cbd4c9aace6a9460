"""LNT070: an overlay declares something that cannot be used."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Finding

from ecm_extract.lint.rule import LintRule
from ecm_extract.lint.workspace import Workspace

RULE = LintRule(
    id="LNT070",
    name="overlay_wrong",
    dimension="versioning",
    severity="error",
    who="safety",
    consequence="nothing of it is used, and no check knows what was meant",
    resolution="correct the line",
    tier="stable",
)
_CODES = (
    "overlay-schema",
    "overlay-not-a-map",
    "overlay-unknown-key",
    "overlay-unknown-section",
    "overlay-unknown-field",
    "overlay-unknown-module",
    "overlay-wrong-value",
)


def check(workspace: Workspace) -> Iterator[Finding]:
    """Report what of each `ecm.yaml` means nothing."""
    workspace.assemble()
    for entry in workspace.diagnostics(*_CODES):
        package = workspace.package_of(entry.path)
        evidence = [Evidence(entry.path, entry.line)]
        resolution = entry.advice[:1].lower() + entry.advice[1:]
        yield RULE.finding(entry.wrong, Entity("overlay", entry.wrong), package, evidence, resolution=resolution)
