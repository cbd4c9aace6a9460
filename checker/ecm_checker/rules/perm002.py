"""A module comes nearer to people than the policy grants."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.grants import contact, denied_findings
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM002",
    name="human_contact_not_permitted",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermSat", "PermChainSafe"),
    consequence="the robot comes near a person without being allowed to",
    resolution="have close interaction reviewed and granted, or keep the distance",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask for against what the policy grants."""
    return denied_findings(case, RULE, "physical", contact)
