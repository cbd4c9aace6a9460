"""A controller claims a command interface that the hardware does not export."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="RES011",
    name="command_interface_not_exported",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("ResSat", "ResJointSat", "AllocSat"),
    consequence="the controller manager refuses to activate the controller",
    resolution="export the interface in the robot description, or configure the controller for one that exists",
)


def check(case: Case) -> Iterator[Finding]:
    """Claims of the form `joint/interface` against those that the hardware exports."""
    robot = case.profiles.embodiment
    if robot is None or robot.command_interfaces is None:
        return
    for claim in sorted(case.claims.keys() - set(robot.command_interfaces)):
        if "/" in claim.strip("/"):
            holders = case.claims[claim]
            evidence = [line for each in holders for line in each.evidence("resources.exclusive_locks")]
            text = f"{claim} of {holders[0].id} is not exported by the hardware"
            yield RULE.finding(text, Entity("command_interface", claim), holders, evidence)
