"""A module moves in a way or a place that the policy does not grant."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.grants import denied_findings, scopes
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM001",
    name="motion_not_permitted",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermSat", "PermChainSafe"),
    consequence="the robot moves where it must not, or governance stops it in the middle of a task",
    resolution="have the scope granted, or choose a module that does without it",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask for against what the policy grants."""
    return denied_findings(case, RULE, "physical", scopes)
