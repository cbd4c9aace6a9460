"""`std_msgs/Header` at the start of a message, read without decoding the message."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Final, NamedTuple

_LONGEST_FRAME: Final = 256
_NS: Final = 1_000_000_000


class Header(NamedTuple):
    """Stamp in nanoseconds since 1970, and the bytes of the frame: they become text once a stream."""

    stamp_ns: int
    frame: bytes


ReadHeader = Callable[[bytes | memoryview], Header | None]

_ROS1: Final = struct.Struct("<IIII")
_CDR_LITTLE: Final = struct.Struct("<iII")
_CDR_BIG: Final = struct.Struct(">iII")
_ENCAPSULATION: Final = 4


def ros1_header(raw: bytes | memoryview) -> Header | None:
    """The header of a serialised ROS 1 message; None when the bytes are none."""
    if len(raw) < _ROS1.size:
        return None
    _, seconds, nanoseconds, length = _ROS1.unpack_from(raw)
    return _header(seconds, nanoseconds, raw, _ROS1.size, length)


def cdr_header(raw: bytes | memoryview) -> Header | None:
    """The header of a message in CDR; None when the bytes are none."""
    if len(raw) < _ENCAPSULATION + _CDR_LITTLE.size:
        return None
    form = _CDR_LITTLE if raw[1] & 1 else _CDR_BIG
    seconds, nanoseconds, length = form.unpack_from(raw, _ENCAPSULATION)
    return _header(seconds, nanoseconds, raw, _ENCAPSULATION + form.size, length)


def _header(seconds: int, nanoseconds: int, raw: bytes | memoryview, start: int, length: int) -> Header | None:
    if length > _LONGEST_FRAME or start + length > len(raw) or nanoseconds >= _NS:
        return None
    return Header(seconds * _NS + nanoseconds, bytes(raw[start : start + length]))
