"""A module must be audited more strongly than the policy offers."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.grants import audit, denied_findings
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM007",
    name="audit_not_offered",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermSat", "PermChainSafe"),
    consequence="what the robot did cannot be traced as required",
    resolution="raise the audit of the deployment, or choose a module that needs less",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask for against what the policy grants."""
    return denied_findings(case, RULE, "audit", audit)
