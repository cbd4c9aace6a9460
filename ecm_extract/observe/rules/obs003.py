"""An endpoint has another type than its contract or its peer says."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.rule import ObserveRule, line_of
from ecm_extract.observe.watch import Link, Pair, Watch

RULE = ObserveRule(
    id="OBS003",
    name="type_differs",
    dimension="signature",
    severity="error",
    who="wire",
    consequence="the two never connect",
    resolution="run versions of one interface package, or correct the side that is wrong",
)


def check(watch: Watch) -> Iterator[Finding]:
    """What was seen against the contract, and publishers against subscribers."""
    for pair in watch.pairs:
        if _differs(pair.seen.type, pair.expected.interface.type):
            yield _against_contract(pair)
    told: set[Entity] = set()
    for link in watch.topics:
        entity = Entity("topic", link.giver.name, f"{link.giver.type} {link.taker.type}")
        if _differs(link.giver.type, link.taker.type) and entity not in told:
            told.add(entity)
            yield _between(link, entity)


def _differs(one: str | None, two: str | None) -> bool:
    return one is not None and two is not None and "{" not in one + two and one != two


def _against_contract(pair: Pair) -> Finding:
    seen, module = pair.seen, pair.expected.module
    where = seen.node or "who publishes it"
    text = f"{seen.name}: {where} uses {seen.type}, the contract of {module.id} says {pair.expected.interface.type}"
    entity = Entity(seen.role, seen.name, seen.type or "")
    return RULE.seen(text, entity, (module.id, seen.node or seen.name), line_of(pair.expected))


def _between(link: Link, entity: Entity) -> Finding:
    giver, taker = link.giver.node or "a publisher", link.taker.node or "a subscriber"
    text = f"{link.giver.name}: {giver} publishes {link.giver.type}, {taker} subscribes to {link.taker.type}"
    return RULE.seen(text, entity, (giver, taker))
