"""Two modules share a name, and the type on one side is not known."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case, Wire
from ecm_checker.endpoint_types import types
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.roles import roles
from ecm_checker.qos import sources
from ecm_checker.rule import Rule

RULE = Rule(
    id="SIG012",
    name="type_unknown",
    dimension="signature",
    severity="warning",
    who="wire",
    part_of=("SigMatch",),
    consequence="whether the two connect cannot be decided before they run",
    resolution="declare the type in an overlay (ecm.yaml), or look at the lines named",
)


def check(case: Case) -> Iterator[Finding]:
    """Topics, services and actions that two modules share; a hint when they only could run together."""
    for wire in case.wires:
        if wire.giver is not wire.taker and (types(wire.offered) is None or types(wire.wanted) is None):
            yield _finding(case, roles()[wire.role].provides, wire)


def _finding(case: Case, kind: str, wire: Wire) -> Finding:
    side = wire.giver if types(wire.offered) is None else wire.taker
    return RULE.finding(
        f"{kind} {wire.name} of {wire.giver.id} and {wire.taker.id}: its type in {side.id} is not known",
        Entity(kind, wire.name),
        (wire.giver, wire.taker),
        sources(wire),
        certainty="unknown",
        severity="warning" if case.together else "info",
    )
