"""A best-effort publisher meets a reliable subscriber."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.match.qos_fit import level_fits
from ecm_checker.qos import mismatches
from ecm_checker.rule import Rule

RULE = Rule(
    id="BEH001",
    name="qos_reliability",
    dimension="behavior",
    severity="error",
    who="qos",
    part_of=("BehMatch",),
    tier="qos",
    consequence="the two never connect; the subscriber waits for ever without an error",
    resolution="publish reliably, or subscribe with best effort",
)


def check(case: Case) -> Iterator[Finding]:
    """Request and offer of every topic that two modules share."""
    return mismatches(case, RULE, "reliability", level_fits)
