"""What every node has without its own doing."""

from __future__ import annotations

import re
from functools import cache
from typing import Final

import msgspec

from ecm_extract.shipped import shipped_as

_NUMBER: Final = re.compile(r"(?:_\d+)+$")


class TopicsOfRole(msgspec.Struct, frozen=True):
    """A role of a contract as topics of the graph."""

    role: str
    topics: tuple[str, ...]


class Tools(msgspec.Struct, frozen=True):
    """Nodes of the tools."""

    nodes: tuple[str, ...]


class Helpers(msgspec.Struct, frozen=True):
    """How the names of nodes begin that a library makes for others."""

    prefixes: tuple[str, ...]


class Standard(msgspec.Struct, frozen=True):
    """The table `standard.toml`."""

    every_node: dict[str, tuple[str, ...]]
    by_role: dict[str, TopicsOfRole]
    tools: Tools
    helpers: Helpers


@cache
def standard() -> Standard:
    """Return the table that ships with the package."""
    return shipped_as("observe/standard.toml", Standard)


def is_standard(role: str, name: str, node: str | None) -> bool:
    """Whether every node has this endpoint by its client library."""
    own = f"~{name.removeprefix(node)}" if node and name.startswith(f"{node}/") else name
    return own in standard().every_node.get(role, ())


def is_tool(node: str) -> bool:
    """Whether a node belongs to a tool: the hidden ones begin with an underscore."""
    return _NUMBER.sub("", node) in standard().tools.nodes or node.rpartition("/")[2].startswith("_")


def is_helper(node: str) -> bool:
    """Whether a library made a node for another one, which has its endpoints in truth."""
    return node.rpartition("/")[2].startswith(standard().helpers.prefixes)
