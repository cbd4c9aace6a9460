"""Names of an instance: in its namespace, below its node, with its parameters and remaps.

Sources: wiki.ros.org/Names; design.ros2.org "Topic and Service name mapping", "Remapping names".
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

from ecm_checker.gaps import with_gaps
from ecm_checker.hub.local_name import LocalName, Parts, Teller

from ecm_extract.link.naming.filling import filled
from ecm_extract.system.model import Remapping, join


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


def resolve(local: LocalName, around: Around) -> list[Resolved]:
    """Return the names that an endpoint has in the graph: several when a parameter holds a list.

    Args:
        local: for any namespace and node.
        around: the node.
    """
    if local.space and not around.namespace.strip("/"):
        around = around._replace(namespace=f"/{local.space}")
    used = tuple(part.label for part in local.parts if not isinstance(part, str) and part.of == "parameter")
    namespace = around.namespace.rstrip("/")
    known: dict[Teller, str] = {
        "node": around.node,
        "namespace": namespace,
        "above": namespace.rpartition("/")[0],
    }
    return [_remapped(_told(name, known), used, around) for name in filled(local.parts, around.parameter)]


def _told(name: Parts, known: Mapping[Teller, str]) -> str:
    """Fill in what a node is called; a name that a parameter gives is put below a namespace only if it is relative."""
    text = ""
    for part in reversed(name):
        if isinstance(part, str):
            text = part + text
        elif part.of not in known:
            text = part.shown + text
        elif text.startswith("//"):
            return text[1:]
        else:
            text = known[part.of] + text
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
    runs = [""]
    for part in pattern.strip("/").split("/"):
        if part == "**":
            runs.append("")
        else:
            runs[-1] += f"/{_one_part(part)}(?=/|\\Z)"
    return re.fullmatch(with_gaps(runs, "(?:/[^/]+)*"), full_name) is not None


def _one_part(part: str) -> str:
    return with_gaps([re.escape(text) for text in part.split("*")], "[^/]+")
