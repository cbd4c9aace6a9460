"""A ROS 1 graph of our own on loopback: a master, nodes by XML-RPC, publishers by TCPROS, and peers that misbehave."""

from __future__ import annotations

import socket
import struct
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from typing import Any
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

TWIST = "geometry_msgs/Twist"
HANG_S = 60.0
TWIST_MD5 = "9f195f881246fdfa2798d1d3eebca84a"


class _Handler(SimpleXMLRPCRequestHandler):
    rpc_paths = ()

    def log_message(self, *_: Any) -> None:
        """Keep quiet."""


@dataclass
class Publisher:
    topic: str
    type: str
    md5: str
    definition: str = "Vector3 linear\nVector3 angular\n"
    raw: bytes = b"\0" * 48
    hz: float = 50.0
    latching: str = "0"


@dataclass
class FakeNode:
    """A node: what it publishes, subscribes (topic -> type) and serves (name -> (type, md5))."""

    name: str
    publishers: list[Publisher] = field(default_factory=list)
    subscriptions: dict[str, str] = field(default_factory=dict)
    services: dict[str, tuple[str, str]] = field(default_factory=dict)


class Graph:
    """Serves nodes; everything ends with `stop`."""

    def __init__(self, nodes: list[FakeNode], parameters: dict[str, Any] | None = None) -> None:
        self.nodes = {node.name: node for node in nodes}
        self.parameters = parameters or {}
        self.calls: list[str] = []
        self._servers: list[SimpleXMLRPCServer] = []
        self._over = threading.Event()
        self._sockets: list[socket.socket] = []
        self.addresses = {name: self._serve(self._node_methods(node)) for name, node in self.nodes.items()}
        self.tcpros = self._listen(self._publisher)
        self.uri = self._serve(self._master_methods())

    def _serve(self, methods: dict[str, Callable[..., Any]]) -> str:
        server = SimpleXMLRPCServer(("127.0.0.1", 0), _Handler, logRequests=False, allow_none=True)
        for name, method in methods.items():
            server.register_function(self._noted(name, method), name)
        threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.02}, daemon=True).start()
        self._servers.append(server)
        return f"http://127.0.0.1:{server.server_address[1]}/"

    def _noted(self, name: str, method: Callable[..., Any]) -> Callable[..., Any]:
        def noted(*arguments: Any) -> Any:
            self.calls.append(name)
            return method(*arguments)

        return noted

    def _master_methods(self) -> dict[str, Callable[..., Any]]:
        nodes = self.nodes.values()

        def rows(pairs: Iterator[tuple[str, str]]) -> list[Any]:
            found: dict[str, list[str]] = {}
            for name, node in pairs:
                found.setdefault(name, []).append(node)
            return [[name, owners] for name, owners in found.items()]

        def state(_caller: str) -> Any:
            return (
                1,
                "",
                [
                    rows((each.topic, node.name) for node in nodes for each in node.publishers),
                    rows((topic, node.name) for node in nodes for topic in node.subscriptions),
                    rows((name, node.name) for node in nodes for name in node.services),
                ],
            )

        def types(_caller: str) -> Any:
            return 1, "", [[each.topic, each.type] for node in nodes for each in node.publishers]

        return {
            "getSystemState": state,
            "getTopicTypes": types,
            "getParam": lambda _caller, _name: (1, "", self.parameters),
            "lookupNode": lambda _caller, name: (1, "", self.addresses[name]),
            "lookupService": lambda _caller, _name: (1, "", f"rosrpc://127.0.0.1:{self.tcpros}"),
        }

    def _node_methods(self, node: FakeNode) -> dict[str, Callable[..., Any]]:
        return {
            "getSubscriptions": lambda _caller: (1, "", [[name, kind] for name, kind in node.subscriptions.items()]),
            "requestTopic": lambda _caller, topic, _protocols: (1, node.name, ["TCPROS", "127.0.0.1", self.tcpros]),
        }

    def _listen(self, serve: Callable[[socket.socket], None]) -> int:
        listener = socket.create_server(("127.0.0.1", 0))
        self._sockets.append(listener)

        def accept() -> None:
            while not self._over.is_set():
                try:
                    connection, _ = listener.accept()
                except OSError:
                    return
                self._sockets.append(connection)
                threading.Thread(target=self._guarded, args=(serve, connection), daemon=True).start()

        threading.Thread(target=accept, daemon=True).start()
        return int(listener.getsockname()[1])

    def _guarded(self, serve: Callable[[socket.socket], None], connection: socket.socket) -> None:
        with suppress(OSError), connection:
            serve(connection)

    def _publisher(self, connection: socket.socket) -> None:
        fields = read_header(connection)
        if "service" in fields:
            kind, md5 = next(node.services[fields["service"]] for node in self.nodes.values() if node.services)
            connection.sendall(header(type=kind, md5sum=md5))
            return
        each = next(one for node in self.nodes.values() for one in node.publishers if one.topic == fields["topic"])
        connection.sendall(
            header(type=each.type, md5sum=each.md5, message_definition=each.definition, latching=each.latching)
        )
        while not self._over.wait(1 / each.hz):
            connection.sendall(struct.pack("<I", len(each.raw)) + each.raw)

    def stop(self) -> None:
        self._over.set()
        for server in self._servers:
            server.shutdown()
            server.server_close()
        for each in self._sockets:
            each.close()


@contextmanager
def running(*nodes: FakeNode, parameters: dict[str, Any] | None = None) -> Iterator[Graph]:
    graph = Graph(list(nodes), parameters)
    try:
        yield graph
    finally:
        graph.stop()


def header(**fields: str) -> bytes:
    lines = [f"{key}={value}".encode() for key, value in fields.items()]
    body = b"".join(struct.pack("<I", len(line)) + line for line in lines)
    return struct.pack("<I", len(body)) + body


def read_header(connection: socket.socket) -> dict[str, str]:
    (size,) = struct.unpack("<I", connection.recv(4, socket.MSG_WAITALL))
    data, found = connection.recv(size, socket.MSG_WAITALL), {}
    while data:
        (length,) = struct.unpack("<I", data[:4])
        key, _, value = data[4 : 4 + length].decode().partition("=")
        found[key] = value
        data = data[4 + length :]
    return found


@contextmanager
def answering(answer: Callable[[socket.socket], None]) -> Iterator[str]:
    """The address of a peer that does what it is told with each connection, and nothing else."""
    listener = socket.create_server(("127.0.0.1", 0))
    taken: list[socket.socket] = []

    def accept() -> None:
        while True:
            try:
                connection, _ = listener.accept()
            except OSError:
                return
            taken.append(connection)
            threading.Thread(target=guarded, args=(connection,), daemon=True).start()

    def guarded(connection: socket.socket) -> None:
        with suppress(OSError):
            answer(connection)

    threading.Thread(target=accept, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{listener.getsockname()[1]}/"
    finally:
        listener.close()
        for each in taken:
            each.close()


def http(body: bytes) -> bytes:
    return b"HTTP/1.0 200 OK\r\nContent-Type: text/xml\r\nContent-Length: %d\r\n\r\n" % len(body) + body


def silent(_connection: socket.socket) -> None:
    time.sleep(HANG_S)


def dripping(connection: socket.socket) -> None:
    """A byte now and then, so that no single read ever times out."""
    for byte in http(b" " * round(HANG_S / 0.05)):
        connection.sendall(bytes([byte]))
        time.sleep(0.05)
