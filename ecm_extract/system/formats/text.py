"""A system in words for a person: what runs, who talks to whom, what is connected on one side only."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

import networkx as nx

from ecm_extract.report.terminal import one_line
from ecm_extract.system.frames import FrameEdge
from ecm_extract.system.graph import Channel, channels, graph_of
from ecm_extract.system.node_model import SystemNode
from ecm_extract.system.system import System

_SIDES = {"topic": ("pub", "sub"), "service": ("client", "server"), "action": ("client", "server")}
_OUTSIDE = {False: "source not in the tree", True: "no source in the tree, endpoints by table"}
MAX_FRAMES = 60
MAX_DEPTH = 40


def render(system: System) -> str:
    """Return the text; every name from a file is on one line and free of control characters."""
    found = channels(system.nodes)
    lines = [
        *_head(system, found),
        *_nodes(system.nodes),
        *_channels(found),
        *_controllers(system),
        *_frames(system.frames),
    ]
    return "\n".join(one_line(line, 400) for line in lines) + "\n"


def _head(system: System, found: list[Channel]) -> Iterator[str]:
    commit = f" ({system.tree.commit[:12]})" if system.tree.commit else ""
    graph = graph_of(system.nodes)
    groups = nx.number_weakly_connected_components(graph) if graph else 0
    counts = {kind: sum(1 for entry in found if entry.kind == kind) for kind in _SIDES}
    yield f"{system.tree.label}{commit}: {', '.join(system.launched.files[:1])}"
    kinds = ", ".join(f"{counts[kind]} {kind}s" for kind in _SIDES)
    yield f"{len(system.nodes)} nodes, {kinds}, {groups} connected groups; {len(system.launched.files)} launch files"
    open_arguments = [entry.name for entry in system.launched.arguments if entry.value is None]
    if open_arguments:
        yield f"arguments without a value: {', '.join(open_arguments)} (give them as NAME:=VALUE)"


def _nodes(nodes: Iterable[SystemNode]) -> Iterator[str]:
    yield ""
    yield "nodes"
    for node in nodes:
        instance = node.instance
        code = instance.plugin or f"{instance.package}/{instance.executable}"
        notes = [
            *([f"in {instance.container}"] if instance.container else []),
            *([f"if {instance.conditional}"] if instance.conditional else []),
            *([_OUTSIDE[bool(node.endpoints)]] if not node.modules and instance.kind != "simulated" else []),
        ]
        yield f"  {node.name}  {code}{'  [' + '; '.join(notes) + ']' if notes else ''}"


def _channels(found: list[Channel]) -> Iterator[str]:
    for kind, (source, target) in _SIDES.items():
        entries = [entry for entry in found if entry.kind == kind]
        if not entries:
            continue
        yield ""
        yield f"{kind}s"
        for entry in entries:
            types = " | ".join(entry.types) or "type not known"
            yield f"  {entry.name}  {types}"
            yield f"      {source}: {', '.join(entry.sources) or '-'}   {target}: {', '.join(entry.targets) or '-'}"


def _controllers(system: System) -> Iterator[str]:
    if not system.controllers:
        return
    yield ""
    yield "controllers"
    for entry in system.controllers:
        claims = "claims not known" if entry.claims is None else ", ".join(entry.claims) or "claims nothing"
        state = "" if entry.active else " (inactive)"
        yield f"  {entry.name}{state}  {entry.type or 'type not known'}: {claims}"


def _frames(frames: list[FrameEdge]) -> Iterator[str]:
    if not frames:
        return
    yield ""
    yield "frames"
    tree: nx.DiGraph[str] = nx.DiGraph()
    tree.add_edges_from((edge.parent, edge.child) for edge in frames)
    roots = [name for name in sorted(tree) if tree.in_degree(name) == 0] or sorted(tree)[:1]
    shown = 0
    for root in roots:
        for depth, name in _walk(tree, root):
            if shown == MAX_FRAMES:
                yield f"  and {len(tree) - shown} more: see --format json"
                return
            shown += 1
            yield f"  {'  ' * depth}{name}"


def _walk(tree: nx.DiGraph[str], root: str) -> Iterator[tuple[int, str]]:
    pending, seen = [(0, root)], set()
    while pending:
        depth, name = pending.pop()
        if name in seen or depth > MAX_DEPTH:
            continue
        seen.add(name)
        yield depth, name
        pending.extend((depth + 1, child) for child in sorted(tree.successors(name), reverse=True))
