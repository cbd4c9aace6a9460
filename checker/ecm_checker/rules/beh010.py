"""A new version assumes more or promises less than the one before."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.predicates import Predicate, implies
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="BEH010",
    name="behavior_changed",
    dimension="behavior",
    severity="warning",
    who="safety",
    part_of=("DepPreserve",),
    consequence="planners that reason with the old conditions call it where it does not work",
    resolution="check the planners and compositions that use it against the new conditions",
)


def check(case: Case) -> Iterator[Finding]:
    """Preconditions that are new, postconditions that are gone, other completion, lower rates."""
    old = case.previous
    for new in case.modules if old is not None else ():
        assert old is not None
        for text, entity in (*_conditions(old, new), *_completion(old, new), *_rates(old, new)):
            evidence = new.evidence(
                "behavior.preconditions", "behavior.postconditions", "behavior.completion_semantics"
            )
            yield RULE.finding(text, entity, (new,), evidence, certainty="unknown")


def _conditions(old: View, new: View) -> Iterator[tuple[str, Entity]]:
    for wanted in _not_implied(old.preconditions, new.preconditions):
        yield f"{new.id} now requires {wanted.text!r}", Entity("precondition", "", wanted.text)
    for lost in _not_implied(new.postconditions, old.postconditions):
        yield f"{new.id} no longer establishes {lost.text!r}", Entity("postcondition", lost.text)


def _not_implied(known: tuple[Predicate, ...] | None, wanted: tuple[Predicate, ...] | None) -> list[Predicate]:
    return [each for each in wanted or () if all(implies(one, each) != "implied" for one in known or ())]


def _completion(old: View, new: View) -> Iterator[tuple[str, Entity]]:
    if old.completion is not None and old.completion != new.completion:
        text = f"{new.id} now completes with {new.completion or 'undeclared semantics'}, before {old.completion}"
        yield text, Entity("completion", old.completion, new.completion or "")


def _rates(old: View, new: View) -> Iterator[tuple[str, Entity]]:
    for name, before in old.rates.items():
        now = new.rates.get(name)
        if now is None or now < before:
            shown = "undeclared" if now is None else f"{now:g} Hz"
            yield f"{new.id}: {name} now has rate {shown}, before {before:g} Hz", Entity("rate", name)
