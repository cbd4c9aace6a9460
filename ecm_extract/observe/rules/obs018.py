"""Messages come in another frame than the contract says."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker import frames
from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.rule import ObserveRule, line_of
from ecm_extract.observe.watch import Watch

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
        wanted = frames.known(pair.expected.interface.frame)
        if pair.seen.role != "publisher" or wanted is None:
            continue
        found = seen.get((pair.seen.name, pair.seen.node)) or seen.get((pair.seen.name, None), ())
        others = sorted(frame for frame in found if frames.canonical(frame) != wanted)
        if others:
            module = pair.expected.module.id
            text = f"{pair.seen.name} comes in {', '.join(others)}, the contract of {module} says {wanted}"
            entity = Entity("frame", wanted, others[0])
            subjects = (module, pair.seen.node or pair.seen.name)
            yield RULE.seen(text, entity, subjects, line_of(pair.expected))
