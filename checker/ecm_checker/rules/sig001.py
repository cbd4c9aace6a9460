"""Two modules use one topic with different types."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.endpoint_types import mismatches
from ecm_checker.finding import Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="SIG001",
    name="topic_type_mismatch",
    dimension="signature",
    severity="error",
    who="wire",
    part_of=("SigMatch",),
    tier="schema",
    consequence="the two never connect; the subscriber waits for ever",
    resolution="give both sides one type, or put a module between them that converts",
)


def check(case: Case) -> Iterator[Finding]:
    """Types of every topic that two modules share."""
    return mismatches(RULE, case)
