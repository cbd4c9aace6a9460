"""Stamps and frames of the headers of one stream."""

from __future__ import annotations

from typing import Final

from ecm_extract.observe.hearing.headers import Header

_MOST_FRAMES: Final = 20


class Stamps:
    """Remembers how far stamps lay from their receipt, how often they ran backwards, and which frames came."""

    __slots__ = ("_frames", "_last", "backwards", "earliest_ns", "latest_ns")

    def __init__(self) -> None:
        self.latest_ns: int | None = None
        self.earliest_ns: int | None = None
        self.backwards = 0
        self._frames: set[bytes] = set()
        self._last = 0

    def add(self, header: Header, time_ns: int) -> None:
        """Take a header and the time of receipt; a stamp of zero says nothing."""
        if header.frame not in self._frames and len(self._frames) < _MOST_FRAMES:
            self._frames.add(header.frame)
        if not header.stamp_ns:
            return
        age = time_ns - header.stamp_ns
        if self.latest_ns is None or age > self.latest_ns:
            self.latest_ns = age
        if self.earliest_ns is None or age < self.earliest_ns:
            self.earliest_ns = age
        self.backwards += header.stamp_ns < self._last
        self._last = header.stamp_ns

    @property
    def frames(self) -> tuple[str, ...]:
        """Frames that came, by name."""
        names = {frame.rstrip(b"\0").decode("utf-8", "replace") for frame in self._frames}
        return tuple(sorted(names - {""}))
