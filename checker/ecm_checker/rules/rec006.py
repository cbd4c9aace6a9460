"""A new version fails or recovers in another way than the one before."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="REC006",
    name="recovery_changed",
    dimension="recovery",
    severity="warning",
    who="safety",
    part_of=("RecDeltaSafe",),
    consequence="who coordinates recovery expects the old answer, and the robot gives another one",
    resolution="check every composition with it again before the upgrade",
)

_FIELDS = ("failure_modes", "rollback", "retry", "safe_stop", "escalation")
_PATHS = {"rollback": "recovery.rollback_state"}


def check(case: Case) -> Iterator[Finding]:
    """Recovery of the old version against that of the new one; what was undeclared promised nothing."""
    old = case.previous
    if old is None:
        return
    for new in case.modules:
        for field in _FIELDS:
            before, now = getattr(old, field), getattr(new, field)
            if before is not None and before != now:
                path = _PATHS.get(field, f"recovery.{field}")
                text = f"{path} of {new.id} {'changed' if now is not None else 'is no longer declared'}"
                evidence = (*old.evidence(path), *new.evidence(path))
                yield RULE.finding(text, Entity("recovery", field), (new,), evidence, certainty="unknown")
