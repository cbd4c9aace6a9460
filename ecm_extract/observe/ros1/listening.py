"""Listening to publishers: one thread, every connection without blocking."""

from __future__ import annotations

import selectors
import socket
import time
from contextlib import suppress
from typing import Final

from ecm_extract.observe.hearing.contents import DECODED
from ecm_extract.observe.hearing.heard import Channel, Heard
from ecm_extract.observe.ros1.frames import Frames

MOST_CONNECTIONS: Final = 800
_BLOCK: Final = 1 << 18
_HEADER_BYTES: Final = 512
_DECODED_BYTES: Final = 4_000_000


class Listening:
    """Connections that send messages."""

    def __init__(self, heard: Heard) -> None:
        self._heard = heard
        self._selector = selectors.DefaultSelector()
        self.count = 0

    def add(self, connection: socket.socket, channel: Channel) -> None:
        """Listen to a publisher."""
        listener = self._heard.listener(channel)

        def receive(kept: bytes, size: int) -> None:
            listener.message(kept, time.time_ns(), size=size)

        keep = _DECODED_BYTES if channel.type in DECODED else _HEADER_BYTES
        connection.setblocking(False)
        self._selector.register(connection, selectors.EVENT_READ, Frames(receive, keep))
        self.count += 1

    def run(self, until: float) -> None:
        """Take what comes until a time of `time.monotonic`."""
        while (left := until - time.monotonic()) > 0:
            if not self._selector.get_map():
                time.sleep(left)
                return
            for key, _ in self._selector.select(min(left, 0.2)):
                self._take(key)

    def close(self) -> None:
        """Leave every publisher."""
        for key in list(self._selector.get_map().values()):
            self._drop(key)
        self._selector.close()

    def _take(self, key: selectors.SelectorKey) -> None:
        connection = key.fileobj
        assert isinstance(connection, socket.socket)
        try:
            data = connection.recv(_BLOCK)
        except (BlockingIOError, InterruptedError):
            return
        except OSError:
            data = b""
        if data:
            key.data.feed(data)
        else:
            self._drop(key)

    def _drop(self, key: selectors.SelectorKey) -> None:
        connection = key.fileobj
        assert isinstance(connection, socket.socket)
        self._selector.unregister(connection)
        with suppress(OSError):
            connection.close()
