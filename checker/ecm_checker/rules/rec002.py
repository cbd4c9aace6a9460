"""A module that moves the robot tries again, but says nothing of a safe stop."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="REC002",
    name="retry_without_safe_stop",
    dimension="recovery",
    severity="warning",
    who="safety",
    part_of=("RecMatch", "FailureSat"),
    consequence="when the retries are used up the robot stops wherever it is, under force or in motion",
    resolution="declare what it does when it cannot recover",
)


def check(case: Case) -> Iterator[Finding]:
    """Modules that move and retry."""
    for module in case.modules:
        if module.retry is not None and module.retry.count > 0 and module.moves() and not module.safe_stop:
            none = module.safe_stop is not None
            text = f"{module.id} retries and {'has no safe stop' if none else 'its safe stop is undeclared'}"
            evidence = module.evidence("recovery.retry")
            certainty: Certainty = "proved" if none else "unknown"
            yield RULE.finding(text, Entity("safe_stop", module.id), (module,), evidence, certainty=certainty)
