"""Types on both sides of a name of the ROS graph."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_checker.case import Case
from ecm_checker.contract import Interface
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.roles import roles
from ecm_checker.qos import certainty_of, is_named, sources
from ecm_checker.rule import Rule


def types(endpoints: Iterable[Interface]) -> set[str] | None:
    """Types that are known; None when one of them is not, as then nothing can be excluded."""
    found = {entry.type for entry in endpoints}
    return None if None in found else {kind for kind in found if kind is not None and "{" not in kind}


def mismatches(rule: Rule, case: Case) -> Iterator[Finding]:
    """Findings of a rule that rows of roles name, for wires whose sides have no type in common."""
    for wire in case.wires:
        row = roles()[wire.role]
        if row.mismatch != rule.id:
            continue
        offered, wanted = types(wire.offered), types(wire.wanted)
        if not offered or not wanted or not offered.isdisjoint(wanted):
            continue
        gives, takes = "|".join(sorted(offered)), "|".join(sorted(wanted))
        kind, asks = row.provides, roles()[row.peer].does
        text = f"{kind} {wire.name}: {wire.giver.id} {row.does} {gives}, {wire.taker.id} {asks} {takes}"
        yield rule.finding(
            text,
            Entity(kind, wire.name, f"{gives} {takes}"),
            (wire.giver, wire.taker),
            sources(wire),
            certainty=certainty_of(wire),
            # A name that is the default of a parameter is often set, and then the two never were one topic.
            severity=None if is_named(wire) else "info",
        )
