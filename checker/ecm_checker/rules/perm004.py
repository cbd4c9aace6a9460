"""A module talks to a host or service that the policy does not allow."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.grants import denied_findings, network
from ecm_checker.rule import Rule

RULE = Rule(
    id="PERM004",
    name="network_not_permitted",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermSat", "PermChainSafe"),
    consequence="the module fails when the connection is refused, or data leaves the robot",
    resolution="allow the host, or choose a module that works without it",
)


def check(case: Case) -> Iterator[Finding]:
    """What modules ask for against what the policy grants."""
    return denied_findings(case, RULE, "network", network)
