"""What a module brings about contradicts what the next one takes for granted."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.predicates import settle
from ecm_checker.rule import Rule

RULE = Rule(
    id="BEH009",
    name="assumption_contradicted",
    dimension="behavior",
    severity="error",
    who="safety",
    part_of=("BehMatch",),
    consequence="the module acts on a world that is not as it assumes",
    resolution="put a module between them that restores what is assumed, or choose one that does not assume it",
)


def check(case: Case) -> Iterator[Finding]:
    """Assumptions and invariants of the second module against postconditions of the first."""
    for first, second in case.adjacent:
        if not first.postconditions:
            continue
        for wanted in (*(second.assumptions or ()), *(second.invariants or ())):
            if settle(first.postconditions, wanted) == "contradicted":
                text = f"after {first.id}, {wanted.text!r} of {second.id} does not hold"
                evidence = (
                    *first.evidence("behavior.postconditions"),
                    *second.evidence("behavior.assumptions", "behavior.invariants"),
                )
                yield RULE.finding(text, Entity("assumption", wanted.text), (first, second), evidence)
