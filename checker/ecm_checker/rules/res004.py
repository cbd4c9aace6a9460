"""A module needs an actuator that the robot does not have."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.demand import actuators, unmet_findings
from ecm_checker.finding import Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="RES004",
    name="actuator_missing",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("ResSat", "ResJointSat", "AllocSat"),
    consequence="the commands of the module move nothing",
    resolution="choose a module for the actuators of the robot",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask of the robot."""
    return unmet_findings(case, RULE, "actuators", actuators)
