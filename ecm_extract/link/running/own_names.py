"""The name and the namespace of the node that the code runs in, with which values begin."""

from __future__ import annotations

from ecm_checker.contract import Confidence

from ecm_extract.link.running.values import NAMESPACE, Hole, Value


def node_name() -> Value:
    """The name of the node that the code runs in."""
    return Value((Hole("node", "node"),), "pattern", beside="folded")


def node_namespace(label: str = NAMESPACE) -> Value:
    """The namespace of the node that the code runs in, or `PARENT_NAMESPACE`, the one above it."""
    return Value((Hole(label, "space"),), "pattern", beside="folded")


def below_namespace(value: Value) -> str | None:
    """Return what comes after the namespace that a value begins with, None for other values."""
    parts = [part for part in value.parts if part]
    if len(parts) < 2 or not isinstance(parts[0], Hole) or parts[0].kind != "space":
        return None
    return Value(tuple(parts[1:])).text.removeprefix("/")


def with_node(value: Value, node: str | None) -> Value:
    """Fill in the name of the node where it is known."""
    if node is None or not value.open("node"):
        return value
    parts = tuple([node if isinstance(part, Hole) and part.kind == "node" else part for part in value.parts])
    rest = any(isinstance(part, Hole) for part in parts)
    return Value(parts, "pattern" if rest else known_beside(value), value.template)


def known_beside(value: Value) -> Confidence:
    """How surely all is known that stands beside the name or the namespace of the node."""
    return value.beside or "folded"
