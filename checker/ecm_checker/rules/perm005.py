"""A module reads or writes data that the policy does not grant."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.grants import data, denied_findings
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM005",
    name="data_not_permitted",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermSat", "PermChainSafe"),
    consequence="the module fails when access is refused, or uses data that it must not see",
    resolution="grant the access, or choose a module that does without it",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask for against what the policy grants."""
    return denied_findings(case, RULE, "data", data)
