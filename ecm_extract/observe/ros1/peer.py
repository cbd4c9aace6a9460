"""Talking to a peer that may lie, hang or send garbage: every exchange has an end in time and a bound in bytes."""

from __future__ import annotations

import socket
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress

TIMEOUT_S = 2.0
"""Longest time that one exchange may take, in seconds."""


class PeerError(Exception):
    """A peer did not answer as the protocol says; the text tells what it did, for people."""


@contextmanager
def cut_off(connection: socket.socket) -> Iterator[None]:
    """Shut a connection down when the time is over, so that a peer that sends a byte now and then holds nobody up."""
    timer = threading.Timer(TIMEOUT_S, _shut, (connection,))
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()


def connected(host: str, port: int) -> socket.socket:
    """A connection to a peer.

    Raises:
        PeerError: nobody answers there.
    """
    try:
        return socket.create_connection((host, port), TIMEOUT_S)
    except (OSError, UnicodeError, OverflowError) as error:
        message = f"nobody answers at {host}:{port} ({error or 'no such host'})"
        raise PeerError(message) from None


def read_exactly(connection: socket.socket, size: int) -> bytes:
    """So many bytes.

    Raises:
        PeerError: the peer left before.
    """
    parts, left = [], size
    while left:
        part = connection.recv(min(left, 1 << 16))
        if not part:
            message = "it left or fell silent in the middle of an answer"
            raise PeerError(message)
        parts.append(part)
        left -= len(part)
    return b"".join(parts)


def _shut(connection: socket.socket) -> None:
    with suppress(OSError):
        connection.shutdown(socket.SHUT_RDWR)
