"""Messages come in another frame than the contract says."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import msgspec
from ecm_checker import frames
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding

from ecm_extract.observe.expected import Expected
from ecm_extract.observe.rule import ObserveRule, line_of
from ecm_extract.observe.watch import Pair, Watch

RULE = ObserveRule(
    id="OBS018",
    name="frame_differs",
    dimension="signature",
    severity="error",
    who="safety",
    consequence="who takes the frame of the contract for granted acts at the wrong place",
    resolution="set the frame of the contract, or let readers transform by the frame of each message",
)


def check(watch: Watch) -> Iterator[Finding]:
    """`header.frame_id` of the messages of a publisher whose contract fixes the frame."""
    seen = {(stream.topic, stream.node): stream.frames for stream in watch.seen.streams}
    for pair in watch.pairs:
        if pair.seen.row.writes:
            found = seen.get((pair.seen.name, pair.seen.node)) or seen.get((pair.seen.name, None), ())
            yield from _others(pair, found)


def _others(pair: Pair, found: Iterable[str]) -> Iterator[Finding]:
    promised = _promised(pair.expected)
    others = sorted(frame for frame in found if promised is not None and frames.canonical(frame) != promised.frame)
    if promised is not None and others:
        module = pair.expected.module.id
        text = f"{pair.seen.name} comes in {', '.join(others)}, the contract of {module} says {promised.frame}"
        entity = Entity("frame", promised.frame, others[0])
        subjects = (module, pair.seen.node or pair.seen.name)
        yield RULE.seen(text, entity, subjects, promised.evidence, certainty=promised.certainty)


class _Promised(msgspec.Struct, frozen=True):
    frame: str
    evidence: tuple[Evidence, ...]
    certainty: Certainty


def _promised(expected: Expected) -> _Promised | None:
    """The frame of the endpoint, else the one frame that the module gives all its data in."""
    own = frames.known(expected.interface.frame)
    if own is not None:
        return _Promised(own, line_of(expected), "proved")
    value = expected.module.contract.signature.coordinate_frame
    common = frames.known(value.value) if value is not None and isinstance(value.value, str) else None
    if value is None or common is None or value.confidence == "pattern":
        return None
    return _Promised(common, value.evidence[:1], "likely" if value.confidence in {"default", "one_of"} else "proved")
