"""A chain has a member that is audited less than another member requires."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.grants import AUDIT_LEVELS
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="PERM011",
    name="audit_gap",
    dimension="permissions",
    severity="warning",
    who="safety",
    part_of=("GlobalSafe",),
    consequence="the trail breaks in the middle of the task",
    resolution="audit all members of the chain as strongly as the strictest of them requires",
)


def check(case: Case) -> Iterator[Finding]:
    """Audit of the members of a chain."""
    if not case.ordered:
        return
    strictest = max((_level(module) for module in case.modules), default=0)
    weaker = [module for module in case.modules if _level(module) < strictest]
    if strictest < AUDIT_LEVELS.index("standard") or not weaker:
        return
    names = ", ".join(module.id for module in weaker)
    text = f"the chain must be audited as {AUDIT_LEVELS[strictest]}, which {names} does not declare"
    evidence = [line for module in case.modules for line in module.evidence("permissions.audit")]
    yield RULE.finding(text, Entity("audit", AUDIT_LEVELS[strictest]), weaker, evidence)


def _level(module: View) -> int:
    return AUDIT_LEVELS.index(module.audit) if module.audit in AUDIT_LEVELS else 0
