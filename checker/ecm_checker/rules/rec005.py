"""A retry drives up a quantity that an invariant bounds."""

from __future__ import annotations

import re
from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.predicates import Predicate
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="REC005",
    name="retry_against_invariant",
    dimension="recovery",
    severity="warning",
    who="safety",
    part_of=("RecMatch",),
    consequence="each retry brings the robot nearer to the bound, and the last one breaks it",
    resolution="bound the retry, or choose a strategy that does not raise the quantity",
)

_RAISES = re.compile(r"(?:increas\w*|rais\w*|more|higher)_(\w+)")


def check(case: Case) -> Iterator[Finding]:
    """Strategies of one module against bounds in the invariants of both."""
    for pair in case.adjacent:
        for module in pair:
            raised = _RAISES.search(module.retry.strategy) if module.retry is not None else None
            if raised is not None and module.retry is not None and module.retry.count > 0:
                yield from _bounded(module, raised[1], pair)


def _bounded(module: View, quantity: str, pair: tuple[View, View]) -> Iterator[Finding]:
    for owner in pair:
        for bound in owner.invariants or ():
            if _speaks_of(bound, quantity):
                text = f"{module.id} retries with more {quantity}, {owner.id} keeps {bound.text!r}"
                subjects = dict.fromkeys((module.id, owner.id))
                evidence = (*module.evidence("recovery.retry"), *owner.evidence("behavior.invariants"))
                modules = (module, owner) if len(subjects) > 1 else (module,)
                entity = Entity("invariant", bound.text)
                yield RULE.finding(text, entity, modules, evidence, certainty="likely")


def _speaks_of(bound: Predicate, quantity: str) -> bool:
    return bound.op in {"<", "<="} and quantity in re.split(r"[._]", bound.subject.lower())
