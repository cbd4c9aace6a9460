"""A precondition is not established by what is known to hold."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.conditions import established, known_in_state
from ecm_checker.finding import Entity, Finding
from ecm_checker.predicates import Predicate, settle
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="BEH008",
    name="precondition_not_established",
    dimension="behavior",
    severity="error",
    who="safety",
    part_of=("BehMatch", "PreSat"),
    consequence="the module starts in a state in which it does not work as specified",
    resolution="let the module before establish it, or state in the runtime profile that it holds",
)


def check(case: Case) -> Iterator[Finding]:
    """Preconditions of a called module, and of a module that another one hands over to."""
    if case.call is not None:
        for module in case.modules:
            yield from _unsettled(module, known_in_state(case), (module,))
    for first, second in case.adjacent:
        yield from _unsettled(second, established(case, first), (first, second))


def _unsettled(module: View, known: tuple[Predicate, ...], subjects: tuple[View, ...]) -> Iterator[Finding]:
    evidence = module.evidence("behavior.preconditions")
    for wanted in module.preconditions or ():
        verdict = settle(known, wanted)
        if verdict == "implied":
            continue
        wrong = verdict == "contradicted"
        text = (
            f"{module.id} requires {wanted.text!r}, {'which does not hold' if wrong else 'which nothing establishes'}"
        )
        entity = Entity("precondition", wanted.text)
        yield RULE.finding(text, entity, subjects, evidence, certainty="proved" if wrong else "unknown")
