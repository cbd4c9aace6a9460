"""A publisher and a subscriber that run have QoS that can never match."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.model import Endpoint, Incident
from ecm_extract.observe.qos_match import misfits
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Link, Watch

RULE = ObserveRule(
    id="OBS005",
    name="qos_never_matches",
    dimension="behavior",
    severity="error",
    who="qos",
    consequence="the two never connect; not one message arrives, and neither side fails",
    resolution="offer at least what is asked for, or ask for less",
)


def check(watch: Watch) -> Iterator[Finding]:
    """Every publisher with every subscriber; then what the middleware reported of others."""
    told: set[tuple[str, str]] = set()
    for link in watch.topics:
        for policy in _misfits(link):
            told.add((link.giver.name, policy))
            yield _finding(link, policy)
    for incident in watch.seen.incidents:
        if incident.kind == "incompatible_qos" and (incident.name, incident.detail) not in told:
            yield _reported(incident)


def _misfits(link: Link) -> Iterator[str]:
    giver, taker = link.giver, link.taker
    if giver.qos is not None and taker.qos is not None:
        unseen = {*giver.unseen, *taker.unseen}
        yield from (policy for policy in misfits(giver.qos, taker.qos) if policy not in unseen)


def _finding(link: Link, policy: str) -> Finding:
    giver, taker = link.giver.node or "a publisher", link.taker.node or "a subscriber"
    text = (
        f"{link.giver.name}: {giver} offers {policy} {_shown(link.giver, policy)}, "
        f"{taker} asks for {_shown(link.taker, policy)}"
    )
    return RULE.seen(text, Entity("qos", link.giver.name, f"{policy} {giver} {taker}"), (giver, taker))


def _shown(end: Endpoint, policy: str) -> str:
    value = getattr(end.qos, policy)
    return f"{value:g}" if isinstance(value, int | float) else str(value or "infinite")


def _reported(incident: Incident) -> Finding:
    text = f"{incident.name}: the middleware reports that {incident.detail or 'a policy'} of two ends does not match"
    subjects = (incident.node or incident.name,)
    return RULE.seen(text, Entity("qos", incident.name, incident.detail), subjects)
