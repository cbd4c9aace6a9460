"""The instance graph: nodes on one side, topics, services and actions on the other, edges by who offers and who uses.

An edge goes with the data: publisher -> topic -> subscriber, client -> service -> server. Built on networkx, so that
whoever has a graph question (reachability, components, cycles) can ask it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import msgspec
import networkx as nx
from ecm_checker.hub.roles import channel_kinds, roles

from ecm_extract.system.node_model import Endpoint, SystemNode


class Channel(msgspec.Struct, frozen=True):
    """A topic, service or action of the graph.

    Attributes:
        kind: what it is. name: in the graph.
        types: message types in use, one when all agree.
        sources: full names of publishers or clients. targets: of subscribers or servers.
    """

    kind: str
    name: str
    types: tuple[str, ...]
    sources: tuple[str, ...]
    targets: tuple[str, ...]


class Edge(NamedTuple):
    """An edge of the graph from vertex to vertex, with the type of what goes over it."""

    start: tuple[str, str]
    end: tuple[str, str]
    type: str


def channel_of(endpoint: Endpoint) -> tuple[str, str] | None:
    """Return kind and name of the channel of an endpoint; None for a lookup that names frames, not the topic."""
    row = roles()[endpoint.role]
    if row.channel is None or (not row.shape and endpoint.type is None):
        return None
    return (row.channel, endpoint.name)


def channels(nodes: Iterable[SystemNode]) -> list[Channel]:
    """Return all channels, topics before services before actions, each by name."""
    found: dict[tuple[str, str], list[Endpoint]] = {}
    for node in nodes:
        for endpoint in node.endpoints:
            key = channel_of(endpoint)
            if key is not None:
                found.setdefault(key, []).append(endpoint)
    order = channel_kinds()
    return [
        _channel(kind, name, entries)
        for (kind, name), entries in sorted(found.items(), key=lambda item: (order.index(item[0][0]), item[0][1]))
    ]


def _channel(kind: str, name: str, endpoints: list[Endpoint]) -> Channel:
    return Channel(
        kind,
        name,
        tuple(sorted({entry.type for entry in endpoints if entry.type is not None})),
        tuple(sorted({entry.node for entry in endpoints if roles()[entry.role].sends})),
        tuple(sorted({entry.node for entry in endpoints if not roles()[entry.role].sends})),
    )


def graph_of(nodes: Iterable[SystemNode]) -> nx.MultiDiGraph[Any]:
    """Return the graph: vertices `("node", name)` and `("topic" | "service" | "action", name)`."""
    graph: nx.MultiDiGraph[Any] = nx.MultiDiGraph()
    for node in nodes:
        graph.add_node(("node", node.name), conditional=node.instance.conditional)
        for start, end, endpoint in _edges(node):
            graph.add_edge(start, end, role=endpoint.role, type=endpoint.type)
    return graph


def edges_of(graph: nx.MultiDiGraph[Any]) -> list[Edge]:
    """Return each edge once for each type that goes over it, in a stable order; the type is empty where not known."""
    return sorted({Edge(start, end, data.get("type") or "") for start, end, data in graph.edges(data=True)})


def _edges(node: SystemNode) -> Iterator[tuple[tuple[str, str], tuple[str, str], Endpoint]]:
    for endpoint in node.endpoints:
        channel = channel_of(endpoint)
        if channel is None:
            continue
        own = ("node", node.name)
        yield (own, channel, endpoint) if roles()[endpoint.role].sends else (channel, own, endpoint)
