"""A module needs a control rate or latency that the robot does not reach."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.demand import timing, unmet_findings
from ecm_checker.finding import Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="RES006",
    name="timing_insufficient",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("ResSat", "ResJointSat", "AllocSat"),
    consequence="the control loop runs too slowly and may become unstable",
    resolution="run the loop on a faster computer, or choose a module that needs less",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask of the robot."""
    return unmet_findings(case, RULE, "timing", timing)
