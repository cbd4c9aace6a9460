"""What the master knows: who publishes, subscribes and serves what, where nodes are, and all parameters."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Final, TypeAlias

import msgspec

from ecm_extract.observe.model import Parameter
from ecm_extract.observe.ros1.peer import PeerError
from ecm_extract.observe.ros1.rpc import call

_Row: TypeAlias = tuple[str, list[str]]
_State: TypeAlias = tuple[list[_Row], list[_Row], list[_Row]]
_STATE: Any = _State
_DEEPEST: Final = 32


class Registered(msgspec.Struct, frozen=True):
    """One end that a node registered: `publisher`, `subscriber` or `service_server`."""

    role: str
    name: str
    node: str


class Graph(msgspec.Struct, frozen=True):
    """What is registered, and the type of each topic as the master has it: `package/Name`, `*` when not known."""

    registered: tuple[Registered, ...]
    types: dict[str, str]

    @property
    def nodes(self) -> tuple[str, ...]:
        """Names of all nodes, sorted."""
        return tuple(sorted({each.node for each in self.registered}))


class Master:
    """A master, asked by its URI."""

    def __init__(self, uri: str) -> None:
        self.uri = uri

    def graph(self) -> Graph:
        """What is registered now.

        Raises:
            PeerError: there is no master.
        """
        state: _State = call(self.uri, _STATE, "getSystemState")
        types = call(self.uri, list[tuple[str, str]], "getTopicTypes")
        return Graph(tuple(_registered(state)), dict(types))

    def address(self, node: str) -> str:
        """URI of a node.

        Raises:
            PeerError: the master does not know it.
        """
        return call(self.uri, str, "lookupNode", node)

    def service_address(self, service: str) -> str:
        """`rosrpc://host:port` of a service.

        Raises:
            PeerError: the master does not know it.
        """
        return call(self.uri, str, "lookupService", service)

    def parameters(self) -> tuple[Parameter, ...]:
        """All parameters that are set.

        Raises:
            PeerError: they cannot be read.
        """
        tree = call(self.uri, object, "getParam", "/")
        if not isinstance(tree, Mapping):
            message = "getParam answers with something else than a map"
            raise PeerError(message)
        return tuple(_leaves("", tree, 0))


def _registered(state: _State) -> Iterator[Registered]:
    for role, rows in zip(("publisher", "subscriber", "service_server"), state, strict=True):
        for name, nodes in rows:
            for node in nodes:
                yield Registered(role, name, node)


def _leaves(prefix: str, tree: Mapping[str, Any], depth: int) -> Iterator[Parameter]:
    for key, value in sorted(tree.items()):
        name = f"{prefix}/{key}"
        if isinstance(value, Mapping) and value and depth < _DEEPEST:
            yield from _leaves(name, value, depth + 1)
        else:
            yield Parameter(name, value)
