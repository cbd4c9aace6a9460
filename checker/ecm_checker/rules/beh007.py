"""A topic is published less often than its subscriber needs."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.roles import Role, roles
from ecm_checker.qos import sources
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="BEH007",
    name="rate_below_required",
    dimension="behavior",
    severity="error",
    who="safety",
    part_of=("BehMatch",),
    consequence="the subscriber works on old data, or stops because its watchdog runs out",
    resolution="publish faster, or lower the rate that the subscriber requires",
)


def check(case: Case) -> Iterator[Finding]:
    """Rates on both sides of every topic that two modules share."""
    for wire in case.topics:
        if not wire.giver.rates or not wire.taker.rates or wire.giver is wire.taker:
            continue
        offered = _rate(wire.giver, wire.role, wire.name)
        required = _rate(wire.taker, roles()[wire.role].peer, wire.name)
        if offered is not None and required is not None and offered < required:
            text = f"{wire.name}: {wire.giver.id} publishes {offered:g} Hz, {wire.taker.id} needs {required:g} Hz"
            evidence = (*sources(wire), *wire.giver.evidence("behavior.rates"))
            yield RULE.finding(text, Entity("rate", wire.name), (wire.giver, wire.taker), evidence)


def _rate(module: View, role: Role, name: str) -> float | None:
    return module.rates.get(f"{role} {name}", module.rates.get(name))
