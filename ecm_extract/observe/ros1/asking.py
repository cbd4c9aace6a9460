"""Asking the master and every node, and remembering what each said; who fails is a gap."""

from __future__ import annotations

import socket
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import Final, TypeVar

import msgspec
from ecm_checker.hub.roles import roles

from ecm_extract.observe.model import Endpoint, Parameter
from ecm_extract.observe.ros1.handshake import Header, service_header, topic_connection
from ecm_extract.observe.ros1.master import Graph, Master, Registered
from ecm_extract.observe.ros1.peer import PeerError
from ecm_extract.observe.ros1.rpc import call
from ecm_extract.observe.standard import is_standard, is_tool

_WORKERS: Final = 64
_Key = tuple[str, str, str]
_Asked = TypeVar("_Asked")


class Publication(msgspec.Struct, frozen=True):
    """A connection to a publisher that sends from now on, and what it said of itself."""

    end: Registered
    header: Header
    connection: socket.socket


class Answers:
    """What is known so far of one graph.

    Attributes:
        graph: what is registered. addresses: URI of each node. parameters: all that are set.
        gaps: what could not be read, with the reason.
    """

    def __init__(self, master: Master) -> None:
        self.master = master
        self.graph = Graph((), {})
        self.addresses: dict[str, str] = {}
        self.parameters: tuple[Parameter, ...] = ()
        self.gaps: dict[str, str] = {}
        self._subscriptions: dict[str, dict[str, str]] = {}
        self._headers: dict[_Key, Header] = {}

    def look(self) -> Iterator[Publication]:
        """Ask the master, then every node, publisher and service that was not asked before; yield new publishers.

        Raises:
            PeerError: there is no master.
        """
        self.graph = self.master.graph()
        self.attempt("the parameters", self._read_parameters)
        with ThreadPoolExecutor(_WORKERS) as pool:
            new = [node for node in self.graph.nodes if node not in self.addresses and not is_tool(node)]
            list(pool.map(self._ask_node, new))
            ends = [each for each in self.graph.registered if self._is_to_be_asked(each)]
            yield from filter(None, pool.map(self._ask_end, ends))

    def attempt(self, what: str, ask: Callable[[], _Asked]) -> _Asked | None:
        """What asking gives; None when the peer fails, which is kept as a gap."""
        try:
            return ask()
        except PeerError as error:
            self.gaps[what] = str(error)
            return None

    def endpoints(self) -> Iterator[Endpoint]:
        """Yield everything that is registered, with what its node says of it before what the master says."""
        for each in self.graph.registered:
            header = self._headers.get(_key(each), {})
            told = header.get("type") or self._subscriptions.get(each.node, {}).get(each.name)
            if told in {None, "*"} and not roles()[each.role].serves:
                told = self.graph.types.get(each.name)
            kind = full_type(told, roles()[each.role].shape)
            digest, definition = header.get("md5sum") or None, header.get("message_definition") or None
            yield Endpoint(each.role, each.name, kind, each.node, digest, definition)

    def _read_parameters(self) -> None:
        self.parameters = self.master.parameters()

    def _is_to_be_asked(self, end: Registered) -> bool:
        known = end.node in self._subscriptions and _key(end) not in self._headers
        tells = not roles()[end.role].reads and not is_standard(end.role, end.name, end.node)
        return known and tells and _what(end) not in self.gaps

    def _ask_node(self, node: str) -> None:
        def ask() -> None:
            self.addresses[node] = self.master.address(node)
            self._subscriptions[node] = dict(call(self.addresses[node], list[tuple[str, str]], "getSubscriptions"))

        self.addresses.setdefault(node, "")
        self.attempt(node, ask)

    def _ask_end(self, end: Registered) -> Publication | None:
        return self.attempt(_what(end), lambda: self._told(end))

    def _told(self, end: Registered) -> Publication | None:
        if roles()[end.role].writes:
            connection, header = topic_connection(self.addresses[end.node], end.name)
            self._headers[_key(end)] = header
            return Publication(end, header, connection)
        self._headers[_key(end)] = service_header(self.master.service_address(end.name), end.name)
        return None


def full_type(told: str | None, kind: str) -> str | None:
    """`package/Name` with its kind between; None for `*`."""
    package, slash, name = (told or "").partition("/")
    return f"{package}/{kind}/{name}" if slash and name else None


def _key(end: Registered) -> _Key:
    return end.role, end.name, end.node


def _what(end: Registered) -> str:
    return f"{end.role.replace('_', ' ')} {end.name} of {end.node}"
