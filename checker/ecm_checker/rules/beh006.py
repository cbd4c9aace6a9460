"""A topic keeps its last message for late joiners, but the message expires."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case, Wire
from ecm_checker.finding import Entity, Finding
from ecm_checker.qos import setting, sources
from ecm_checker.rule import Rule

RULE = Rule(
    id="BEH006",
    name="qos_lifespan",
    dimension="behavior",
    severity="info",
    who="qos",
    part_of=("BehMatch",),
    consequence="who joins later than that gets nothing, although it asks for the last message",
    resolution="publish again within the lifespan, or leave the lifespan infinite",
)


def check(case: Case) -> Iterator[Finding]:
    """Topics whose late joiners are promised a message that has expired."""
    for wire in case.topics:
        if _expires(wire) and _latched(wire):
            text = f"{wire.name}: messages of {wire.giver.id} expire, {wire.taker.id} wants the last one"
            yield RULE.finding(text, Entity("qos", wire.name, "lifespan"), (wire.giver, wire.taker), sources(wire))


def _expires(wire: Wire) -> bool:
    return all(setting(offer, "lifespan_ms").value is not None for offer in wire.offered)


def _latched(wire: Wire) -> bool:
    return all(setting(want, "durability").value == "transient_local" for want in wire.wanted)
