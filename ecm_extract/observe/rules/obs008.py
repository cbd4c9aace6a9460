"""A stream of messages was interrupted."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.model import Stream
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS008",
    name="stream_interrupted",
    dimension="behavior",
    severity="warning",
    who="safety",
    consequence="who reads it worked with old data, or stopped, for that long",
    resolution="look at what its publisher and its host did then; a watchdog at the reader makes the gap harmless",
)
_TIMES = 10
_LEAST_S = 0.5
_LEAST_MESSAGES = 20


def check(watch: Watch) -> Iterator[Finding]:
    """Streams with a gap of many times their usual one; what is sent on demand has no usual one."""
    for stream in watch.seen.streams:
        if _interrupted(stream):
            text = (
                f"{stream.topic} was silent for {stream.longest_gap_s:.3g} s, "
                f"else a message comes every {stream.typical_gap_s:.3g} s"
            )
            subjects = (stream.node or stream.topic,)
            yield RULE.seen(text, Entity("gap", stream.topic), subjects, certainty="likely")


def _interrupted(stream: Stream) -> bool:
    gap, typical = stream.longest_gap_s, stream.typical_gap_s
    if gap is None or typical is None or stream.latched or stream.count < _LEAST_MESSAGES:
        return False
    return gap > _LEAST_S and gap > _TIMES * typical
