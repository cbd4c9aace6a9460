"""A module needs more computing power than the robot has."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.demand import compute, unmet_findings
from ecm_checker.finding import Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="RES005",
    name="compute_insufficient",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("ResSat", "ResJointSat", "AllocSat"),
    consequence="the module does not start, or misses its deadlines",
    resolution="run it on a stronger computer, or choose a lighter module",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask of the robot."""
    return unmet_findings(case, RULE, "compute", compute)
