"""A module answers its failure in another way than its neighbour relies on."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule
from ecm_checker.terms import Escalation
from ecm_checker.view import View

RULE = Rule(
    id="REC004",
    name="recovery_conflict",
    dimension="recovery",
    severity="error",
    who="safety",
    part_of=("RecMatch",),
    consequence="one of them retries while the other one already retreats, and neither is in the state it believes",
    resolution="agree on one answer to the failure, or let a coordinator decide before anybody recovers",
)

# A neighbour that speaks of any failure of who comes after or before it.
_ANY_FAILURE = frozenset({"neighbour_failure", "downstream_failure", "successor_failure", "composition_failure"})


def check(case: Case) -> Iterator[Finding]:
    """What one module does on the failure of the other, against what the other does itself."""
    for first, second in case.adjacent:
        for observer, failing in ((first, second), (second, first)):
            for expected in observer.escalation or ():
                own = _own_answer(failing, expected)
                if own is not None and own != expected.action:
                    yield _finding(observer, failing, expected, own)


def _own_answer(failing: View, expected: Escalation) -> str | None:
    """What a module does first on a failure that its neighbour speaks of; None when it is not concerned."""
    modes = failing.failure_modes or {}
    if expected.condition not in modes and not (modes and expected.condition in _ANY_FAILURE):
        return None
    for each in failing.escalation or ():
        if each.condition == expected.condition:
            return each.action
    if failing.retry is not None and failing.retry.count > 0:
        return failing.retry.strategy or "retry"
    return None


def _finding(observer: View, failing: View, expected: Escalation, own: str) -> Finding:
    text = (
        f"on {expected.condition}, {observer.id} relies on {expected.action or 'nothing'}, but {failing.id} does {own}"
    )
    evidence = (
        *observer.evidence("recovery.escalation"),
        *failing.evidence("recovery.retry", "recovery.escalation"),
    )
    return RULE.finding(text, Entity("recovery", expected.action, own), (observer, failing), evidence)
