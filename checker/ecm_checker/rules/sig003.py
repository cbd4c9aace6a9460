"""Two modules use one action with different types."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.endpoint_types import mismatches
from ecm_checker.finding import Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="SIG003",
    name="action_type_mismatch",
    dimension="signature",
    severity="error",
    who="wire",
    part_of=("SigMatch",),
    tier="schema",
    consequence="the client waits for an action server that never becomes available",
    resolution="give both sides one type, or put a module between them that converts",
)


def check(case: Case) -> Iterator[Finding]:
    """Types of every action that two modules share."""
    return mismatches(RULE, case)
