"""The instance graph as a Mermaid flowchart, which forges draw in issues and pages."""

from __future__ import annotations

from ecm_extract.system.graph import edges_of, graph_of
from ecm_extract.system.system import System

_BRACKETS = {"node": ("([", "])"), "topic": ("[", "]"), "service": ("[/", "/]"), "action": ("[[", "]]")}
_OTHER = ("[", "]")


def render(system: System) -> str:
    """Return a `flowchart`; names are quoted, so that nothing in them is syntax."""
    graph = graph_of(system.nodes)
    vertices = sorted(graph.nodes)
    ids = {vertex: f"v{number}" for number, vertex in enumerate(vertices)}
    lines = ["flowchart LR"]
    for vertex in vertices:
        left, right = _BRACKETS.get(vertex[0], _OTHER)
        lines.append(f"  {ids[vertex]}{left}{_quoted(vertex[1])}{right}")
    for edge in edges_of(graph):
        label = f"|{_quoted(edge.type)}|" if edge.type else ""
        lines.append(f"  {ids[edge.start]} -->{label} {ids[edge.end]}")
    return "\n".join(lines) + "\n"


def _quoted(text: str) -> str:
    plain = "".join(char for char in text if char.isprintable())
    return '"' + plain.replace("&", "&amp;").replace('"', "&quot;").replace("<", "&lt;").replace(">", "&gt;") + '"'
