"""A publisher's liveliness lease is longer than its subscriber accepts."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.match.qos_fit import duration_fits
from ecm_checker.qos import mismatches
from ecm_checker.rule import Rule

RULE = Rule(
    id="BEH005",
    name="qos_lease",
    dimension="behavior",
    severity="error",
    who="qos",
    part_of=("BehMatch",),
    tier="qos",
    consequence="the two never connect; the subscriber takes the publisher for dead",
    resolution="shorten the lease of the publisher, or lengthen that of the subscriber",
)


def check(case: Case) -> Iterator[Finding]:
    """Request and offer of every topic that two modules share."""
    return mismatches(case, RULE, "lease_ms", duration_fits)
