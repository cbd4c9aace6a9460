"""A module uses more force or speed than the policy allows."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.grants import denied_findings, limits
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM003",
    name="limit_exceeded",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermSat", "PermChainSafe"),
    consequence="the robot may hurt people or break things",
    resolution="lower the limit in the module, or have a higher one reviewed",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask for against what the policy grants."""
    return denied_findings(case, RULE, "physical", limits)
