"""Names of an instance: in its namespace, below its node, with its parameters and remaps.

Sources: wiki.ros.org/Names; design.ros2.org "Topic and Service name mapping", "Remapping names".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from ecm_extract.link.naming.filling import filled
from ecm_extract.link.naming.own_spaces import unmarked
from ecm_extract.link.running.values import NAMESPACE, PARENT_NAMESPACE
from ecm_extract.system.model import Remapping, join

_PARAMETER = re.compile(r"\$\{([^={}]+)=((?:[^{}]|\{[^{}]*\})*)\}")


class Resolved(NamedTuple):
    """A name in the graph, the name before remaps, the remap that changed it and the parameters that gave it."""

    name: str
    before: str
    remap: Remapping | None
    parameters: tuple[str, ...]


class Around(NamedTuple):
    """Where a name is resolved: namespace and name of the node, its remaps, what the launch sets.

    `parameter` gives the value that the launch sets for a parameter, None when it sets none.
    """

    namespace: str
    node: str
    remaps: Sequence[Remapping]
    parameter: Callable[[str], Any]


def resolve(local: str, around: Around) -> list[Resolved]:
    """Return the names that an endpoint has in the graph: several when a parameter holds a list.

    Args:
        local: for any namespace and node, as `ecm_extract.link.naming.names.local_name` gives it.
        around: the node.
    """
    own = unmarked(local)
    if own.space:
        is_given = bool(around.namespace.strip("/"))
        return resolve(own.name, around if is_given else around._replace(namespace=f"/{own.space}"))
    used = tuple(match[1] for match in _PARAMETER.finditer(local))
    above = around.namespace.rstrip("/").rpartition("/")[0]
    known = {"node": around.node, NAMESPACE: around.namespace.rstrip("/"), PARENT_NAMESPACE: above}
    return [_remapped(_told(text, known), used, around) for text in filled(local, around.parameter)]


def _told(text: str, known: Mapping[str, str]) -> str:
    """Fill in what a node is called; a name that a parameter gives is put below a namespace only if it is relative."""
    for label, value in known.items():
        head, found, rest = text.partition(f"{{{label}}}")
        if found:
            text = rest[1:] if rest.startswith("//") else f"{head}{value}{_told(rest, known)}"
    return text


def _remapped(text: str, used: tuple[str, ...], around: Around) -> Resolved:
    before = absolute(text, around.namespace, around.node)
    for remap in around.remaps:
        node, separator, name = remap.source.partition(":")
        if separator and not name.startswith("//"):  # `node:name` is for this node of a process alone
            remap = replace(remap, source=name if node == around.node else "")
        if remap.source and absolute(remap.source, around.namespace, around.node) == before:
            return Resolved(absolute(remap.target, around.namespace, around.node), before, remap, used)
    return Resolved(before, before, None, used)


def absolute(name: str, namespace: str, node: str) -> str:
    """Return a name as seen from a node: `/x` as it is, `~/x` below the node, else below its namespace."""
    bare = name.strip()
    if "://" in bare:  # rostopic:// and rosservice:// of ROS 2 remap rules
        bare = bare.split("://", 1)[1]
    if bare.startswith("~"):
        return join(join(namespace, node), bare[1:].lstrip("/")) if bare.strip("~/") else join(namespace, node)
    return join(namespace, bare)


def node_matches(pattern: str | None, full_name: str) -> bool:
    """Tell whether the section of a parameter file is for a node: `*` is one part, `**` any number of parts."""
    if pattern is None:
        return True
    if "*" not in pattern:
        return pattern == full_name
    parts = [
        "(?:/[^/]+)*" if part == "**" else "/" + re.escape(part).replace(r"\*", "[^/]+")
        for part in pattern.strip("/").split("/")
    ]
    return re.fullmatch("".join(parts), full_name) is not None
