"""Two modules claim one exclusive resource."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="RES001",
    name="exclusive_double_claim",
    dimension="resources",
    severity="error",
    who="safety",
    part_of=("ResJointSat", "GlobalSafe"),
    consequence="the second claim is refused, or both drive the hardware against each other",
    resolution="let one of them claim it, or switch between them so that they are never active together",
)


def check(case: Case) -> Iterator[Finding]:
    """Command interfaces, devices and locks with more than one holder."""
    for claim, holders in case.claims.items():
        if len(holders) > 1:
            text = f"{claim} is claimed by {', '.join(holder.id for holder in holders)}"
            evidence = [line for each in holders for line in each.evidence("resources.exclusive_locks")]
            yield RULE.finding(text, Entity("claim", claim), holders, evidence)
