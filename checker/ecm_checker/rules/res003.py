"""A module needs a sensor that the robot does not have."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.demand import sensors, unmet_findings
from ecm_checker.finding import Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="RES003",
    name="sensor_missing",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("ResSat", "ResJointSat", "AllocSat"),
    consequence="the module waits for data for ever, or works with data of another meaning",
    resolution="mount the sensor, or choose a module that works with those of the robot",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask of the robot."""
    return unmet_findings(case, RULE, "sensors", sensors)
