"""A module fails in a way that its caller cannot handle."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Certainty, Entity, Finding, Severity
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="REC001",
    name="failure_not_handled",
    dimension="recovery",
    severity="error",
    who="safety",
    part_of=("FailureSat",),
    consequence="the task stops in an undefined state when it fails in this way",
    resolution="handle the failure in the caller, or let the module escalate it to somebody who does",
)


def check(case: Case) -> Iterator[Finding]:
    """Failure modes and completion semantics of a called module against what its caller can handle."""
    if case.call is None:
        return
    for module in case.modules:
        yield from _failures(module, case.call.handles)
        accepted = case.call.completion
        if accepted is not None and module.completion and module.completion not in accepted:
            text = f"{module.id} completes with {module.completion}, which its caller cannot go on from"
            evidence = module.evidence("behavior.completion_semantics")
            yield RULE.finding(text, Entity("completion", module.completion), (module,), evidence)


def _failures(module: View, handles: tuple[str, ...] | None) -> Iterator[Finding]:
    evidence = module.evidence("recovery.failure_modes")
    if module.failure_modes is None or (module.failure_modes and handles is None):
        side = "what its caller handles is" if module.failure_modes else "its failure modes are"
        text = f"how {module.id} fails cannot be compared, {side} undeclared"
        yield RULE.finding(text, Entity("failure", ""), (module,), evidence, certainty="unknown")
        return
    for mode, grade in module.failure_modes.items():
        if handles is not None and mode not in handles and "*" not in handles:
            severity, certainty = _graded(module, grade)
            text = f"{module.id} may fail with {mode} ({grade}), which its caller does not handle"
            yield RULE.finding(
                text, Entity("failure", mode), (module,), evidence, severity=severity, certainty=certainty
            )


def _graded(module: View, grade: object) -> tuple[Severity, Certainty]:
    """A transient failure that the module retries itself is no more than a condition."""
    retried = module.retry is not None and module.retry.count > 0
    return ("warning", "likely") if grade == "transient" and retried else ("error", "proved")
