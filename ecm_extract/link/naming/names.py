"""ROS names: from what a call passes to the name in the graph.

Sources: ROS wiki "Names", design.ros2.org "Topic and Service name mapping". The launch namespace is not known from
source alone, so names resolve in `/`, or in the namespace that the code gives its node (`Node("demo", "arm")`).
"""

from __future__ import annotations

from typing import NamedTuple

from ecm_extract.link.naming.handle import Handle, under
from ecm_extract.link.running.own_names import with_node
from ecm_extract.link.running.values import Hole, OfParameter, Value, joined, literal, settled, without_defaults


class RosName(NamedTuple):
    """A name as written (after folding, relative to its handle), and as it is in the graph of a node in `/`."""

    raw: str
    resolved: str


def space_of(handle: Handle, node: str | None) -> str:
    """Return the namespace that code gives a node: what stands before its name; empty without one."""
    own = handle.node.text if handle.node is not None else node or ""
    return own.rpartition("/")[0].strip("/")


def endpoint_name(value: Value, handle: Handle, node: str | None, ros: int | None) -> RosName:
    """Return the name of a topic, service or action; `node` may have its namespace before its name."""
    raw = value.text
    own = _after(value, "node")
    if own is not None:
        return RosName(f"~{own}" if ros == 1 else raw, _private(own, handle, node))
    beside = _after(value, "space")
    if beside is not None:
        return RosName(raw, _clean(f"/{space_of(handle, node)}/{beside}"))
    if raw.startswith("/"):
        return RosName(raw, _clean(raw))
    if raw.startswith("~"):
        return RosName(raw, _private(raw[1:].lstrip("/"), handle, node))
    below = under(handle.prefix, value)
    own = _after(below, "node")  # `create_sub_node(get_name())`
    if own is not None:
        return RosName(f"~{own}" if ros == 1 else raw, _private(own, handle, node))
    relative = below.text
    if relative.startswith("~"):
        return RosName(relative, _private(relative[1:].lstrip("/"), handle, node))
    return RosName(relative if ros == 1 else raw, _clean(f"/{space_of(handle, node)}/{relative}"))


def below_own_name(value: Value) -> str | None:
    """Return what is below the node's own name with which a value begins; None for other values."""
    return _after(value, "node")


def is_beside_node(value: Value) -> bool:
    """Tell whether a value is the namespace of the node and known text below it."""
    return _after(value, "space") is not None


def is_never_made(value: Value, name: RosName, ros: int | None) -> bool:
    """Tell whether a name is certainly empty, in no namespace either: sources ask first, `if (topic != "")`.

    ROS 2 has no empty names in a namespace either (rcl/validate_topic_name.h).
    """
    return value.text == "" and not value.template and (name.resolved == "/" or ros == 2)


def without_empty_default(value: Value) -> Value:
    """Leave a name open that is empty unless somebody says what stands in it: only then something is made of it."""
    if settled(value).text.strip("/"):
        return value
    if not any(isinstance(part, OfParameter) for part in value.template):
        return without_defaults(value)
    parts = [Hole(part.parameter) if isinstance(part, OfParameter) else part for part in value.template]
    return value._replace(parts=tuple(parts), confidence="pattern")


def _after(value: Value, kind: str) -> str | None:
    """What is below the node's own name or namespace, with which a value begins, holes as `{label}`; None for others.

    `get_name() + "/x"` is `~/x` and `get_namespace() + "/x"` is `x` while the node stands in the root namespace.
    """
    parts = [part for part in value.parts if part]
    if not is_below_node(value) or not isinstance(parts[0], Hole) or parts[0].kind != kind:
        return None
    return Value(tuple(parts[1:])).text.lstrip("/")


def is_below_node(value: Value) -> bool:
    """Tell whether a value is the node's own name or namespace followed by what is surely below it."""
    parts = [part for part in value.parts if part]
    if len(parts) < 2 or not isinstance(parts[0], Hole) or parts[0].kind not in {"node", "space"}:
        return False
    return isinstance(parts[1], str) and parts[1].startswith("/")


def is_below_handle(value: Value, handle: Handle) -> bool:
    """Tell whether the handle that a name is given to decides where it is."""
    if value.text.startswith("~"):
        return handle.node is not None
    return not value.text.startswith("/") and not is_below_node(value)


def of_node(value: Value, node: str | None, ros: int | None) -> Value:
    """Fill in the name of the node; in ROS 1 a name below it is private, whatever name a launch file gives the node.

    There the name of a node begins with a slash (ros/this_node.h, rospy/names.py): no handle puts anything before it.
    """
    if ros == 1 and is_below_node(value):
        return settled(value)
    first = next((part for part in value.parts if part), None)
    absolute = ros == 1 and isinstance(first, Hole) and first.kind == "node"
    named = joined([(literal("/"),), (value,)])[0] if absolute else value
    return settled(with_node(named, node and node.rpartition("/")[2]))


def _private(rest: str, handle: Handle, node: str | None) -> str:
    own = handle.node.text if handle.node is not None else node
    if own is None:
        return f"~/{rest}" if rest else "~"
    return _clean(f"/{own}/{rest}")


def parameter_name(value: Value, handle: Handle, node: str | None, ros: int | None) -> RosName:
    """Return the name of a parameter: local to its node in ROS 2, a graph name in ROS 1."""
    if ros != 1:
        prefix = handle.prefix.text
        full = f"{prefix}.{value.text}" if prefix and not prefix.startswith("~") else value.text
        return RosName(value.text, full.lstrip("."))
    return endpoint_name(value, handle, node, ros)


def _clean(name: str) -> str:
    while "//" in name:
        name = name.replace("//", "/")
    return name if len(name) == 1 else name.rstrip("/")
