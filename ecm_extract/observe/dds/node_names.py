"""Which node has which endpoint: messages of `ros_discovery_info`, read from their bytes.

Source: ros2/rmw_dds_common, `ParticipantEntitiesInfo.msg`, `NodeEntitiesInfo.msg`, `Gid.msg`. A `Gid` has 24 bytes
up to Humble and 16 from Iron on; a message is of the layout that takes up all of its bytes.
"""

from __future__ import annotations

import struct
from typing import Final, NamedTuple

_LAYOUTS: Final = (16, 24)
_ENCAPSULATION: Final = 4
_KEY: Final = 16
_MOST: Final = 100_000


class NodeEnds(NamedTuple):
    """A node with the keys of its endpoints."""

    name: str
    keys: tuple[bytes, ...]


class _Cursor:
    """Reads CDR, and fails with ValueError where the bytes end."""

    def __init__(self, raw: bytes) -> None:
        self._raw = raw[_ENCAPSULATION:]
        self._number = struct.Struct("<I" if raw[1] & 1 else ">I")
        self.at = 0

    def number(self) -> int:
        self.at = -(-self.at // 4) * 4
        (found,) = self._number.unpack(self.take(4))
        return int(found)

    def count(self) -> int:
        found = self.number()
        if found > _MOST:
            raise ValueError
        return found

    def take(self, size: int) -> bytes:
        found = self._raw[self.at : self.at + size]
        if len(found) != size:
            raise ValueError
        self.at += size
        return found

    def text(self) -> str:
        return self.take(self.count()).rstrip(b"\0").decode("utf-8", "replace")

    def is_over(self) -> bool:
        return -(-self.at // 4) * 4 >= len(self._raw)


def nodes_of(raw: bytes) -> tuple[NodeEnds, ...] | None:
    """Nodes of a participant; None when the bytes are of no layout that is known."""
    if len(raw) < _ENCAPSULATION:
        return None
    for size in _LAYOUTS:
        try:
            return _read(_Cursor(raw), size)
        except ValueError:
            continue
    return None


def _read(cursor: _Cursor, gid: int) -> tuple[NodeEnds, ...]:
    cursor.take(gid)
    found = tuple(_node(cursor, gid) for _ in range(cursor.count()))
    if not cursor.is_over():
        raise ValueError
    return found


def _node(cursor: _Cursor, gid: int) -> NodeEnds:
    namespace, name = cursor.text(), cursor.text()
    readers = [cursor.take(gid) for _ in range(cursor.count())]
    writers = [cursor.take(gid) for _ in range(cursor.count())]
    return NodeEnds(f"{namespace.rstrip('/')}/{name}", tuple(key[:_KEY] for key in (*readers, *writers)))
