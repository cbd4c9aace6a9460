"""A new version asks for more permissions than the one before."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ecm_checker import grants
from ecm_checker.case import Case
from ecm_checker.demand import undeclared
from ecm_checker.finding import Entity, Finding
from ecm_checker.profiles import Policy
from ecm_checker.rule import Rule
from ecm_checker.units import number
from ecm_checker.view import View

RULE = Rule(
    id="PERM010",
    name="permission_broadened",
    dimension="permissions",
    severity="error",
    who="safety",
    part_of=("PermDeltaSafe",),
    consequence="the approval of the old version does not cover what the new one does",
    resolution="have the new permission reviewed before the upgrade",
)

_DENIALS = (
    grants.scopes,
    grants.contact,
    grants.limits,
    grants.network,
    grants.data,
    grants.operational,
)


def check(case: Case) -> Iterator[Finding]:
    """Permissions that the old version did not ask for."""
    old, policy = case.previous, case.profiles.policy
    for new in case.modules if old is not None else ():
        assert old is not None
        before = grants.asked(old)
        denied = _denied(new, policy)
        for key, amount in grants.asked(new).items():
            if key not in before or _more(key[1], amount, before[key]):
                yield _finding(new, key, key in denied)
        if old.physical is not None:
            yield from undeclared(RULE, "permissions.physical", (new,) if new.physical is None else ())


def _denied(new: View, policy: Policy | None) -> set[tuple[str, str]]:
    if policy is None:
        return set()
    return {(each.kind, each.name) for ask in _DENIALS for each in ask(new, policy) if each.certainty == "proved"}


def _finding(new: View, key: tuple[str, str], denied: bool) -> Finding:
    text = f"{new.id} now asks for {key[1]}{', which the policy does not grant' if denied else ''}"
    evidence = new.evidence("permissions.physical", "permissions.data", "permissions.network")
    entity = Entity(key[0], "", key[1])
    return RULE.finding(text, entity, (new,), evidence, certainty="proved" if denied else "unknown")


def _more(name: str, now: Any, before: Any) -> bool:
    """Whether a limit was raised; of nearness to people the smaller number is more."""
    new, old = number(now), number(before)
    if new is None or old is None:
        return bool(now) and not before
    return new < old if name in grants.HUMAN else new > old
