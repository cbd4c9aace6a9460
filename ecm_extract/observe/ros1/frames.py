"""The stream of messages of a connection, cut at their lengths without keeping what is not looked at."""

from __future__ import annotations

import struct
from collections.abc import Callable
from typing import Final

_LENGTH: Final = struct.Struct("<I")

Receive = Callable[[bytes, int], None]


class Frames:
    """Takes bytes as they come and gives each message with its true size.

    Attributes:
        keep: how many bytes of each message are handed on; the rest is counted and dropped.
    """

    def __init__(self, receive: Receive, keep: int) -> None:
        self.keep = keep
        self._receive = receive
        self._head = bytearray()
        self._kept = bytearray()
        self._size = -1
        self._left = 0

    def feed(self, data: bytes) -> None:
        """Take what was read."""
        view = memoryview(data)
        while view:
            view = self._body(view) if self._size >= 0 else self._length(view)

    def _length(self, view: memoryview) -> memoryview:
        missing = _LENGTH.size - len(self._head)
        self._head += view[:missing]
        if len(self._head) == _LENGTH.size:
            (self._size,) = _LENGTH.unpack(self._head)
            self._left = self._size
            self._head.clear()
            self._kept.clear()
            self._finish()
        return view[missing:]

    def _body(self, view: memoryview) -> memoryview:
        part = view[: self._left]
        room = self.keep - len(self._kept)
        if room > 0:
            self._kept += part[:room]
        self._left -= len(part)
        self._finish()
        return view[len(part) :]

    def _finish(self) -> None:
        if self._left == 0:
            self._receive(bytes(self._kept), self._size)
            self._size = -1
