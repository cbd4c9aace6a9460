"""Stamps of messages do not fit the time at which they came."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.model import Stream
from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS017",
    name="stamp_off",
    dimension="behavior",
    severity="warning",
    who="safety",
    consequence="transforms are looked up at the wrong time, and filters drop or mix up messages",
    resolution="synchronise the clocks, or stamp with the time at which the data was taken",
)
_LATE_S = 1.0
_EARLY_S = -0.1


def check(watch: Watch) -> Iterator[Finding]:
    """Streams with stamps far before or after their receipt, or with stamps that run backwards."""
    for stream in watch.seen.streams:
        reasons = list(_reasons(stream))
        if reasons:
            text = f"{stream.topic}: {' and '.join(reasons)}"
            subjects = (stream.node or stream.topic,)
            yield RULE.seen(text, Entity("stamp", stream.topic), subjects, certainty="likely")


def _reasons(stream: Stream) -> Iterator[str]:
    if stream.latched:
        return
    if stream.latest_s is not None and stream.latest_s > _LATE_S:
        yield f"stamps lie up to {stream.latest_s:.3g} s before receipt"
    if stream.earliest_s is not None and stream.earliest_s < _EARLY_S:
        yield f"stamps lie up to {-stream.earliest_s:.3g} s after receipt"
    if stream.backwards:
        yield f"{stream.backwards} stamp(s) lie before the one before them"
