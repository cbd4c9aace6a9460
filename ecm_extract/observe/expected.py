"""What the contract of a module promises under the name that its node really has."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Final

import msgspec
from ecm_checker.contract import Interface
from ecm_checker.view import View

from ecm_extract.observe.standard import standard

Key = tuple[str, str]
"""Role and full name of an endpoint."""

# rospy adds process and milliseconds, roscpp nanoseconds: source, `anonymous=True` and `init_options::AnonymousName`.
_ANONYMOUS: Final = re.compile(r"(?:_\d{3,})+$")


class Expected(msgspec.Struct, frozen=True):
    """An endpoint or parameter that a contract promises, under its name in the graph.

    Attributes:
        module: whose contract. interface: as the contract has it. name: on this node.
    """

    module: View
    interface: Interface
    name: str


def is_node_of(node: str, module: View) -> bool:
    """Whether a node has the name that a contract gives its module.

    The contract of a launched node is called like the node itself; others have the name that the program gives itself,
    which may stand below a namespace.
    """
    named = _ANONYMOUS.sub("", node)
    if module.id.startswith("/"):
        return named == module.id
    own = module.id.removeprefix(f"ecm.{module.package}.")
    dotted = named.strip("/").replace("/", ".")
    return dotted == own or dotted.endswith(f".{own}")


def on_node(module: View, node: str | None) -> Iterator[Expected]:
    """Yield what a contract promises, with the names that they have on a node; None is the root namespace."""
    for interface in module.contract.signature.interfaces:
        yield Expected(module, interface, _name_on(interface, node))


def is_exact(expected: Expected) -> bool:
    """Whether the contract fixes the name, so that it is no pattern and no mere default."""
    return "{" not in expected.name and expected.interface.confidence in {"literal", "folded"}


def graph_keys(expected: Expected) -> tuple[Key, ...]:
    """Return roles and names under which a promise is seen in the graph; a transform is a topic there."""
    table = standard().by_role.get(expected.interface.role)
    if table is not None:
        return tuple((table.role, topic) for topic in table.topics)
    return ((expected.interface.role, expected.name),)


def _name_on(interface: Interface, node: str | None) -> str:
    raw = interface.raw_name
    if node is None or interface.row.transform:
        return interface.name
    if raw.startswith("~"):
        return f"{node}/{raw[1:].lstrip('/')}"
    if interface.row.value or raw.startswith("/") or interface.name != f"/{raw}":
        return interface.name
    return f"{node.rpartition('/')[0]}/{raw}"
