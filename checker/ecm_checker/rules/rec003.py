"""A module returns to a state that the system does not know."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="REC003",
    name="rollback_unreachable",
    dimension="recovery",
    severity="error",
    who="safety",
    part_of=("RecMatch", "FailureSat"),
    consequence="after a failure the robot does not reach the state from which the others go on",
    resolution="roll back to a state that the system has, or add the state",
)


def check(case: Case) -> Iterator[Finding]:
    """Rollback states against the states of the runtime; that one is undeclared matters to who hands over."""
    runtime = case.profiles.runtime
    states = runtime.states if runtime is not None else None
    for module in case.modules:
        if module.rollback and states is not None and module.rollback not in states:
            text = f"{module.id} rolls back to {module.rollback}, the system has {', '.join(states) or 'no state'}"
            evidence = module.evidence("recovery.rollback_state")
            yield RULE.finding(text, Entity("state", module.rollback), (module,), evidence)
    yield from _undeclared([second for _, second in case.adjacent])


def _undeclared(modules: list[View]) -> Iterator[Finding]:
    for module in modules:
        if module.failure_modes and module.rollback is None:
            text = f"{module.id} may fail, and where it rolls back to is undeclared"
            evidence = module.evidence("recovery.failure_modes")
            yield RULE.finding(text, Entity("state", ""), (module,), evidence, certainty="unknown")
