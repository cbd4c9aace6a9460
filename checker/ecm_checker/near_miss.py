"""Users of a name that nothing offers, while almost that name is offered."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

from ecm_checker.case import Case
from ecm_checker.contract import Evidence
from ecm_checker.endpoint_types import types
from ecm_checker.finding import Entity, Finding, Severity
from ecm_checker.hub.roles import Role, roles
from ecm_checker.names import NearNames, Nearness
from ecm_checker.rule import Rule
from ecm_checker.view import View

_FEW: Final = 3


def near_misses(case: Case, rule: Rule) -> Iterator[Finding]:
    """Findings of a rule that rows of roles name, for each name that is only used."""
    for giver, row in roles().items():
        if row.near == rule.id and row.peer:
            yield from _of_role(case, rule, giver, row.peer)


def _of_role(case: Case, rule: Rule, giver: Role, taker: Role) -> Iterator[Finding]:
    """Findings for names of one role.

    Graded: a warning where the spelling differs, a hint where only the namespace does, as launch files set that.
    A near name of another type is another thing.
    """
    if len(case.modules) <= _FEW and _far_apart(case, giver, taker):
        return
    wanted, offered = case.by_name(taker), case.by_name(giver)
    alone = sorted(wanted.keys() - offered.keys())
    unused = offered.keys() - wanted.keys()
    if not alone or not unused:
        return
    kinds = {kind for name in alone for kind in _Side(wanted[name], taker, name).types()}
    names = NearNames(name for name in unused if not kinds.isdisjoint(_Side(offered[name], giver, name).types()))
    for name in alone:
        found = names.near(name)
        if found is None:
            continue
        user, offer = _Side(wanted[name], taker, name), _Side(offered[found[0]], giver, found[0])
        if not user.types().isdisjoint(offer.types()):
            yield _finding(rule, user, offer, found[1])


def _far_apart(case: Case, giver: Role, taker: Role) -> bool:
    """Whether no name of one side is near to one of the other: much cheaper than to look for the names."""
    return all(
        offer.near_keys[giver].isdisjoint(want.near_keys[taker])
        for want in case.modules
        if taker in want.near_keys
        for offer in case.modules
        if giver in offer.near_keys
    )


class _Side(NamedTuple):
    owners: tuple[View, ...]
    role: Role
    name: str

    def types(self) -> set[str]:
        return {kind for owner in self.owners for kind in types(owner.endpoints(self.role)[self.name]) or ()}

    def lines(self) -> Iterator[Evidence]:
        for owner in self.owners:
            for endpoint in owner.endpoints(self.role)[self.name]:
                yield from endpoint.evidence[:1]


def _finding(rule: Rule, user: _Side, offer: _Side, nearness: Nearness) -> Finding:
    severity: Severity = "info" if nearness == "namespace" else "warning"
    text = f"{user.owners[0].id} uses {user.name}, which nothing offers; {offer.owners[0].id} offers {offer.name}"
    return rule.finding(
        text,
        Entity(offer.role, offer.name, user.name),
        (*offer.owners[:1], *user.owners),
        (*offer.lines(), *user.lines()),
        certainty="likely",
        severity=severity,
    )
