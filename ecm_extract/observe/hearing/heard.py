"""Everything that was heard of a graph or a recording, message by message."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final, NamedTuple

import msgspec

from ecm_extract.observe.hearing.arrivals import Arrivals
from ecm_extract.observe.hearing.contents import (
    DECODED,
    DIAGNOSTICS,
    TRANSITION,
    Encoding,
    decoded,
)
from ecm_extract.observe.hearing.headers import cdr_header, ros1_header
from ecm_extract.observe.hearing.stamps import Stamps
from ecm_extract.observe.hearing.statuses import Statuses
from ecm_extract.observe.hearing.transforms import Transforms
from ecm_extract.observe.model import Gap, State, Stream

_NS: Final = 1e-9
_STATIC: Final = "/tf_static"
_EVENT: Final = "/transition_event"
_CLOCK: Final = "/clock"


class Channel(NamedTuple):
    """Where messages come from.

    Attributes:
        topic: full name. node: their writer; None when it is not known.
        type: `package/msg/Name`. encoding: of the bytes.
        headed: whether the type begins with a `std_msgs/Header`. latched: see `Stream`.
    """

    topic: str
    node: str | None
    type: str | None
    encoding: Encoding
    headed: bool = False
    latched: bool = False


class Listener(msgspec.Struct):
    """What was heard on one channel."""

    channel: Channel
    heard: Heard
    arrivals: Arrivals
    stamps: Stamps
    broken: int = 0

    def message(
        self, raw: bytes | memoryview, time_ns: int, *, size: int | None = None, sent_ns: int | None = None
    ) -> None:
        """Take a serialised message.

        Args:
            raw: its bytes, or the first of them.
            time_ns: of its receipt, in nanoseconds.
            size: of the whole message, where `raw` is not all of it.
            sent_ns: when it was sent, where the transport tells: gaps are then free of our own delays.
        """
        self.arrivals.add(sent_ns or time_ns, len(raw) if size is None else size)
        channel = self.channel
        if channel.headed:
            header = ros1_header(raw) if channel.encoding == "ros1" else cdr_header(raw)
            if header is not None:
                self.stamps.add(header, time_ns)
            else:
                self.broken += 1
        elif channel.type in DECODED:
            self._decode(raw)

    def _decode(self, raw: bytes | memoryview) -> None:
        message = decoded(bytes(raw), self.channel.type or "", self.channel.encoding)
        if message is None:
            self.broken += 1
        else:
            self.heard.content(self.channel, message)


class Heard:
    """Collects what listeners hear."""

    def __init__(self) -> None:
        self._listeners: list[Listener] = []
        self._transforms = Transforms()
        self._statuses = Statuses()
        self._states: dict[str, str] = {}

    def listener(self, channel: Channel) -> Listener:
        """Make a listener for a channel. Diagnostics begin with a header and are decoded all the same."""
        plain = channel._replace(headed=channel.headed and channel.type not in DECODED)
        found = Listener(plain, self, Arrivals(), Stamps())
        self._listeners.append(found)
        return found

    def content(self, channel: Channel, message: object) -> None:
        """Take a decoded message."""
        if channel.type == DIAGNOSTICS:
            self._statuses.add(message)
        elif channel.type == TRANSITION:
            self._states[channel.topic.removesuffix(_EVENT)] = message.goal_state.label  # type: ignore[attr-defined]
        else:
            self._transforms.add(message, channel.node, channel.topic.endswith(_STATIC))

    def streams(self) -> tuple[Stream, ...]:
        """How messages came. Where simulated time runs, stamps are not compared with receipt."""
        simulated = any(each.channel.topic == _CLOCK for each in self._listeners)
        return tuple(_stream(each, simulated) for each in self._listeners)

    def span_ns(self) -> tuple[int, int]:
        """First and last receipt in nanoseconds; zero where nothing was heard."""
        times = [each.arrivals for each in self._listeners if each.arrivals.count]
        return min((each.first_ns for each in times), default=0), max((each.last_ns for each in times), default=0)

    def transforms(self) -> Transforms:
        """Transforms that were sent."""
        return self._transforms

    def statuses(self) -> Statuses:
        """Diagnostics that were reported."""
        return self._statuses

    def states(self) -> tuple[State, ...]:
        """States of life cycles, by node."""
        return tuple(State(node, name) for node, name in sorted(self._states.items()))

    def gaps(self) -> Iterator[Gap]:
        """Yield what was heard and could not be read."""
        for each in self._listeners:
            if each.broken:
                yield Gap(each.channel.topic, f"{each.broken} message(s) are no {each.channel.type}")
        if self._transforms.full:
            yield Gap("transforms", "there are too many pairs of frames to keep them all")
        if self._statuses.full:
            yield Gap("diagnostics", "there are too many tasks to keep them all")


def _stream(each: Listener, simulated: bool) -> Stream:
    arrivals, stamps, channel = each.arrivals, each.stamps, each.channel
    known = not simulated
    return Stream(
        topic=channel.topic,
        node=channel.node,
        count=arrivals.count,
        size=arrivals.size,
        hz=arrivals.hz,
        longest_gap_s=arrivals.longest_gap_s,
        typical_gap_s=arrivals.typical_gap_s,
        frames=stamps.frames,
        latest_s=stamps.latest_ns * _NS if known and stamps.latest_ns is not None else None,
        earliest_s=stamps.earliest_ns * _NS if known and stamps.earliest_ns is not None else None,
        backwards=stamps.backwards,
        latched=channel.latched,
    )
