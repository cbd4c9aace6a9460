"""Data is given in one frame and taken in another, and no transform is registered between them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ecm_checker.case import Case, Wire
from ecm_checker.contract import Interface
from ecm_checker.finding import Entity, Finding
from ecm_checker.frames import known
from ecm_checker.handover import handovers
from ecm_checker.qos import certainty_of, sources
from ecm_checker.rule import Rule
from ecm_checker.terms import Field
from ecm_checker.view import View

RULE = Rule(
    id="SIG006",
    name="frame_mismatch",
    dimension="signature",
    severity="error",
    who="safety",
    part_of=("SigMatch", "InputSat"),
    by_absence=True,
    consequence="the robot moves to the right numbers in the wrong place, or drops the data for want of a transform",
    resolution="register a transform between the frames, or convert the data before it is handed over",
)


def check(case: Case) -> Iterator[Finding]:
    """Frames of topics and of what one module hands over to the next."""
    for wire in case.topics:
        yield from _on_wire(case, wire)
    for modules, given, taken in handovers(case):
        yield from _between(case, modules, given, taken)


def _on_wire(case: Case, wire: Wire) -> Iterator[Finding]:
    given, taken = _frames(wire.offered), _frames(wire.wanted)
    if not given or not taken or any(case.connected(one, two) for one in given for two in taken):
        return
    text = (
        f"{wire.name}: {wire.giver.id} publishes in {'|'.join(sorted(given))}, "
        f"{wire.taker.id} expects {'|'.join(sorted(taken))}, and no transform connects them"
    )
    entity = Entity("frame", min(given), min(taken))
    yield RULE.finding(text, entity, (wire.giver, wire.taker), sources(wire), certainty=certainty_of(wire))


def _frames(endpoints: Iterable[Interface]) -> set[str]:
    return {frame for frame in (known(endpoint.frame) for endpoint in endpoints) if frame is not None}


def _between(case: Case, modules: tuple[View, ...], given: Field, taken: Field) -> Iterator[Finding]:
    one = known(given.frame) or _default_frame(modules[:-1])
    two = known(taken.frame) or (_default_frame(modules[-1:]) if given.frame else None)
    if two is None or (one is not None and case.connected(one, two)):
        return
    evidence = [line for each in modules for line in each.evidence("signature.coordinate_frame")]
    shown = one or "no declared frame"
    yield RULE.finding(
        f"{given.name} is given in {shown}, {modules[-1].id} takes {taken.name} in {two}",
        Entity("frame", one or "", two),
        modules,
        evidence,
        certainty="proved" if one is not None else "unknown",
    )


def _default_frame(modules: tuple[View, ...]) -> str | None:
    """The frame that a module declares for all its data."""
    for module in modules:
        value = module.contract.signature.coordinate_frame
        if value is not None and isinstance(value.value, str):
            return known(value.value)
    return None
