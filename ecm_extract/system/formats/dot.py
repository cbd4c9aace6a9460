"""The instance graph for Graphviz: nodes as ellipses, topics as boxes, services and actions as other boxes."""

from __future__ import annotations

from ecm_extract.system.graph import edges_of, graph_of
from ecm_extract.system.system import System

_SHAPES = {"node": "ellipse", "topic": "box", "service": "cds", "action": "component"}
_OTHER = "box"


def render(system: System) -> str:
    """Return a `digraph`; what is started under an unknown condition is dashed."""
    graph = graph_of(system.nodes)
    lines = ["digraph system {", "  rankdir=LR;", '  node [fontname="sans-serif"];']
    for vertex, data in sorted(graph.nodes(data=True)):
        style = ", style=dashed" if data.get("conditional") else ""
        lines.append(f"  {_id(vertex)} [label={_quoted(vertex[1])}, shape={_SHAPES.get(vertex[0], _OTHER)}{style}];")
    for edge in edges_of(graph):
        label = f" [label={_quoted(edge.type)}]" if edge.type else ""
        lines.append(f"  {_id(edge.start)} -> {_id(edge.end)}{label};")
    return "\n".join([*lines, "}"]) + "\n"


def _id(vertex: tuple[str, str]) -> str:
    return _quoted(f"{vertex[0]}:{vertex[1]}")


def _quoted(text: str) -> str:
    plain = "".join(char for char in text if char.isprintable())
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'
