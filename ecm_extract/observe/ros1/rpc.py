"""Calls by XML-RPC, bounded. Source: ROS wiki, "Master API", "Slave API" and "Parameter Server API"."""

from __future__ import annotations

import http.client
import xmlrpc.client
from typing import Any, Final, TypeVar
from urllib.parse import urlsplit

import msgspec

from ecm_extract.observe.ros1 import peer
from ecm_extract.observe.ros1.peer import PeerError, connected, cut_off

CALLER: Final = "/ecm_observe"
_MOST_BYTES: Final = 64_000_000
_BLOCK: Final = 1 << 16
_DEFAULT_PORT: Final = 11311
_Answer = TypeVar("_Answer")


def call(uri: str, kind: type[_Answer], method: str, *arguments: Any) -> _Answer:
    """What a method answers.

    Args:
        uri: `http://host:port/` of a master or node.
        kind: shape of the value that the answer carries; another one is refused.
        method: of the API, called with our name first.
        arguments: what follows.

    Raises:
        PeerError: nobody answers in time, or not as the protocol says.
    """
    try:
        status, text, value = msgspec.convert(_posted(uri, method, arguments), tuple[int, str, Any])
        if status != 1:
            message = f"{method} is refused: {text[:200]}"
            raise PeerError(message)
        return msgspec.convert(value, kind)
    except msgspec.ValidationError as error:
        message = f"{method} answers with something else: {error}"
        raise PeerError(message) from None


def host_and_port(uri: str) -> tuple[str, int]:
    """Both parts of a URI.

    Raises:
        PeerError: it is none.
    """
    try:
        parts = urlsplit(uri)
        host, port = parts.hostname, parts.port
    except ValueError:
        host, port = None, None
    if not host:
        message = f"{uri[:200]!r} is no address"
        raise PeerError(message)
    return host, port or _DEFAULT_PORT


def _posted(uri: str, method: str, arguments: tuple[Any, ...]) -> Any:
    host, port = host_and_port(uri)
    body = xmlrpc.client.dumps((CALLER, *arguments), method).encode()
    connection = http.client.HTTPConnection(host, port, timeout=peer.TIMEOUT_S)
    connection.sock = connected(host, port)
    try:
        with cut_off(connection.sock):
            connection.request("POST", urlsplit(uri).path or "/", body, {"Content-Type": "text/xml"})
            return _parsed(_read(connection.getresponse()))
    except (OSError, http.client.HTTPException) as error:
        message = f"{method} is not answered within {peer.TIMEOUT_S:g} s ({type(error).__name__})"
        raise PeerError(message) from None
    finally:
        connection.close()


def _read(response: http.client.HTTPResponse) -> bytes:
    parts, size = [], 0
    while block := response.read(_BLOCK):
        parts.append(block)
        size += len(block)
        if size > _MOST_BYTES:
            message = f"it answers with more than {_MOST_BYTES // 1_000_000} MB"
            raise PeerError(message)
    return b"".join(parts)


def _parsed(data: bytes) -> Any:
    """XML without entities: an answer needs none, and they are how a few bytes become gigabytes."""
    if b"<!" in data:
        message = "it answers with XML that declares entities"
        raise PeerError(message)
    try:
        return xmlrpc.client.loads(data, use_builtin_types=True)[0][0]
    except xmlrpc.client.Fault as fault:
        message = f"it answers with a fault: {fault.faultString[:200]}"
        raise PeerError(message) from None
    except Exception as error:  # the answer is somebody else's, and the parser raises whatever it leads it to
        message = f"it answers with something that is no XML-RPC ({type(error).__name__})"
        raise PeerError(message) from None
