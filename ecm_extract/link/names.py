"""ROS names: from what a call passes to the name in the graph.

Sources: ROS wiki "Names", design.ros2.org "Topic and Service name mapping". The launch namespace is not known from
source alone, so names resolve in `/`.
"""

from __future__ import annotations

from typing import NamedTuple

from ecm_extract.link.handles import Handle, under
from ecm_extract.link.values import Value


class RosName(NamedTuple):
    """A name as written (after folding, relative to its handle) and as it is in the graph."""

    raw: str
    resolved: str


def endpoint_name(value: Value, handle: Handle, node: str | None, ros: int | None) -> RosName:
    """Return the name of a topic, service or action."""
    raw = value.text
    if raw.startswith("/"):
        return RosName(raw, _clean(raw))
    if raw.startswith("~"):
        return RosName(raw, _private(raw[1:].lstrip("/"), handle, node))
    relative = under(handle.prefix, value).text
    if relative.startswith("~"):
        return RosName(relative, _private(relative[1:].lstrip("/"), handle, node))
    return RosName(relative if ros == 1 else raw, _clean(f"/{relative}"))


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
