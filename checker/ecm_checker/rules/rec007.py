"""A critical failure is neither escalated nor stopped safely."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Certainty, Entity, Finding
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="REC007",
    name="critical_failure_unanswered",
    dimension="recovery",
    severity="warning",
    who="safety",
    part_of=("RecMatch", "FailureSat"),
    consequence="the robot goes on after a critical failure",
    resolution="escalate the failure, or declare a safe stop",
)


def check(case: Case) -> Iterator[Finding]:
    """Critical failure modes of each module."""
    for module in case.modules:
        for mode, grade in (module.failure_modes or {}).items():
            if grade == "critical" and not module.safe_stop and not _escalates(module, mode):
                text = f"{module.id} neither escalates {mode} nor stops safely"
                evidence = module.evidence("recovery.failure_modes")
                known = module.safe_stop is not None and module.escalation is not None
                certainty: Certainty = "proved" if known else "unknown"
                yield RULE.finding(text, Entity("failure", mode), (module,), evidence, certainty=certainty)


def _escalates(module: View, mode: str) -> bool:
    return any(mode in each.condition for each in module.escalation or ())
