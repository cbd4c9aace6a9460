"""A module does something irreversible or safety-critical that the policy does not grant."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.grants import denied_findings, operational
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM006",
    name="operation_not_permitted",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermSat", "PermChainSafe"),
    consequence="the robot does what cannot be undone without being allowed to",
    resolution="have the operation reviewed and granted",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask for against what the policy grants."""
    return denied_findings(case, RULE, "operational", operational)
