"""A new version no longer offers what others use, or asks for more input."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.delta import Lost, lost
from ecm_checker.finding import Certainty, Entity, Finding, Severity
from ecm_checker.hub.roles import Role, roles
from ecm_checker.names import is_known
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="SIG010",
    name="signature_broken",
    dimension="signature",
    severity="error",
    who="graph",
    part_of=("DepPreserve",),
    tier="schema",
    consequence="who uses it waits for ever or is refused",
    resolution="keep the old name or field for one release cycle, or move its users first",
)


def check(case: Case) -> Iterator[Finding]:
    """Endpoints, inputs and outputs of the old version that the new one does not have in that form."""
    old = case.previous
    if old is None:
        return
    for new in case.modules:
        for each in lost(old, new):
            yield from _finding(case, new, each)


def _finding(case: Case, new: View, each: Lost) -> Iterator[Finding]:
    entity = Entity(each.kind, each.old, each.new)
    user_role = _peer(each.kind)
    if case.dependents is None or not user_role or not is_known(each.old):
        certainty: Certainty = "unknown" if case.dependents is None else "likely"
        # A computed name stands for names that the new version may well have.
        severity: Severity = "info" if "{" in each.old else "warning"
        text = f"{new.id}: {each.text}"
        yield RULE.finding(text, entity, (new,), each.evidence, certainty=certainty, severity=severity)
        return
    users = [user for user in case.dependents if each.old in user.endpoints(user_role)]
    if users:
        text = f"{new.id}: {each.text}; used by {', '.join(user.id for user in users)}"
        yield RULE.finding(text, entity, (new, *users), each.evidence)
    else:
        text = f"{new.id}: {each.text}; none of its known users uses it"
        yield RULE.finding(text, entity, (new,), each.evidence, severity="info")


def _peer(kind: str) -> Role:
    """The role of who uses an endpoint; empty for an input or output."""
    return next((row.peer for role, row in roles().items() if role == kind), "")
