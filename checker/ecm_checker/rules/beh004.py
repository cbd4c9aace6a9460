"""A publisher asserts its liveliness in a weaker way than its subscriber accepts."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.match.qos_fit import level_fits
from ecm_checker.qos import mismatches
from ecm_checker.rule import Rule

RULE = Rule(
    id="BEH004",
    name="qos_liveliness",
    dimension="behavior",
    severity="error",
    who="qos",
    part_of=("BehMatch",),
    tier="qos",
    consequence="the two never connect; the subscriber takes the publisher for dead",
    resolution="assert liveliness in the way that the subscriber asks for",
)


def check(case: Case) -> Iterator[Finding]:
    """Request and offer of every topic that two modules share."""
    return mismatches(case, RULE, "liveliness", level_fits)
