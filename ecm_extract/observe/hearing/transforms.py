"""The transforms that were sent, by pair of frames."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Final, NamedTuple

from ecm_extract.observe.model import Transform

_NS: Final = 1_000_000_000
_MOST_PAIRS: Final = 20_000


class _Pose(NamedTuple):
    x: float
    y: float
    z: float
    stamp_ns: int


class _Edge:
    """What was sent of one pair of frames."""

    __slots__ = ("count", "largest_step", "last", "static", "step_ns", "writers")

    def __init__(self) -> None:
        self.count = 0
        self.static = False
        self.writers: set[str] = set()
        self.last: dict[str | None, _Pose] = {}
        self.largest_step = 0.0
        self.step_ns = 0

    def add(self, pose: _Pose, writer: str | None, static: bool) -> None:
        self.count += 1
        self.static = self.static or static
        if writer is not None:
            self.writers.add(writer)
        before = self.last.get(writer)
        if before is not None and pose.stamp_ns > before.stamp_ns:
            way = math.dist(before[:3], pose[:3])
            if way > self.largest_step:
                self.largest_step, self.step_ns = way, pose.stamp_ns - before.stamp_ns
        self.last[writer] = pose


class Transforms:
    """Collects transforms; the number of pairs is bounded, and `full` tells when some were left out."""

    def __init__(self) -> None:
        self._edges: dict[tuple[str, str], _Edge] = {}
        self.full = False

    def add(self, message: Any, writer: str | None, static: bool) -> None:
        """Take a message with `transforms`."""
        for each in message.transforms:
            pair = (each.header.frame_id.lstrip("/"), each.child_frame_id.lstrip("/"))
            edge = self._edges.get(pair)
            if edge is None:
                if len(self._edges) >= _MOST_PAIRS:
                    self.full = True
                    continue
                edge = self._edges[pair] = _Edge()
            edge.add(_pose(each), writer, static)

    def found(self) -> Iterator[Transform]:
        """Yield each pair of frames."""
        for (parent, child), edge in sorted(self._edges.items()):
            yield Transform(
                parent,
                child,
                edge.static,
                edge.count,
                tuple(sorted(edge.writers)),
                edge.largest_step,
                edge.step_ns / _NS,
            )


def _pose(each: Any) -> _Pose:
    way, stamp = each.transform.translation, each.header.stamp
    return _Pose(way.x, way.y, way.z, stamp.sec * _NS + stamp.nanosec)
