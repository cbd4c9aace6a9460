"""A volatile publisher meets a subscriber that wants what was sent before."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.match.qos_fit import level_fits
from ecm_checker.qos import mismatches
from ecm_checker.rule import Rule

RULE = Rule(
    id="BEH002",
    name="qos_durability",
    dimension="behavior",
    severity="error",
    who="qos",
    part_of=("BehMatch",),
    tier="qos",
    consequence="the two never connect; a latched map or description never arrives",
    resolution="publish with transient_local, or subscribe with volatile",
)


def check(case: Case) -> Iterator[Finding]:
    """Request and offer of every topic that two modules share."""
    return mismatches(case, RULE, "durability", level_fits)
