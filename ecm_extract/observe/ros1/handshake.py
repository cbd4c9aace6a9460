"""The headers of TCPROS: what two ends tell each other before the first message. Source: ROS wiki, "TCPROS"."""

from __future__ import annotations

import socket
import struct
from collections.abc import Mapping
from typing import Final, TypeAlias

from ecm_extract.observe.ros1.peer import PeerError, connected, cut_off, read_exactly
from ecm_extract.observe.ros1.rpc import CALLER, call, host_and_port

Header: TypeAlias = Mapping[str, str]

_LENGTH: Final = struct.Struct("<I")
_MOST_BYTES: Final = 4_000_000


def topic_connection(node_uri: str, topic: str) -> tuple[socket.socket, Header]:
    """A connection to a publisher of a topic, which sends messages from now on, and its header.

    Raises:
        PeerError: the node does not offer the topic, or not as the protocol says.
    """
    answer = call(node_uri, tuple[str, str, int], "requestTopic", topic, [["TCPROS"]])
    fields = {"callerid": CALLER, "topic": topic, "type": "*", "md5sum": "*"}
    return _exchanged(answer[1], answer[2], fields)


def service_header(address: str, service: str) -> Header:
    """What a service says of itself when it is asked and not called.

    Raises:
        PeerError: it does not answer as the protocol says.
    """
    host, port = host_and_port(address)
    connection, header = _exchanged(host, port, {"callerid": CALLER, "service": service, "md5sum": "*", "probe": "1"})
    connection.close()
    return header


def _exchanged(host: str, port: int, fields: Header) -> tuple[socket.socket, Header]:
    connection = connected(host, port)
    try:
        with cut_off(connection):
            connection.sendall(_packed(fields))
            (size,) = _LENGTH.unpack(read_exactly(connection, _LENGTH.size))
            if size > _MOST_BYTES:
                message = f"it sends a header of {size} bytes"
                raise PeerError(message)
            header = unpacked(read_exactly(connection, size))
    except OSError as error:
        connection.close()
        message = f"it does not answer ({type(error).__name__})"
        raise PeerError(message) from None
    except PeerError:
        connection.close()
        raise
    if "error" in header:
        connection.close()
        raise PeerError(header["error"][:500])
    return connection, header


def _packed(fields: Header) -> bytes:
    lines = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(_LENGTH.pack(len(line)) + line for line in lines)
    return _LENGTH.pack(len(body)) + body


def unpacked(data: bytes) -> dict[str, str]:
    """Fields of a header; what does not fit into it is left out."""
    found, at = {}, 0
    while at + _LENGTH.size <= len(data):
        (size,) = _LENGTH.unpack_from(data, at)
        line = data[at + _LENGTH.size : at + _LENGTH.size + size]
        key, equals, value = line.partition(b"=")
        if equals:
            found[key.decode("utf-8", "replace")] = value.decode("utf-8", "replace")
        at += _LENGTH.size + size
    return found
