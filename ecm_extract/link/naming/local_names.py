"""Names for any namespace and node, of the parts of values."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final

from ecm_checker.hub.local_name import LocalName, OpenPart, Parts, Teller, joined

from ecm_extract.link.naming.handle import Handle
from ecm_extract.link.naming.names import below_own_name, is_beside_node, space_of
from ecm_extract.link.running.values import NAMESPACE, PARENT_NAMESPACE, Hole, OfParameter, Value

_OF: Final[Mapping[str, Teller]] = {"node": "node", "param": "caller", "made": "caller"}
"""Who tells holes of a kind, where anybody does."""
_OF_SPACE: Final[Mapping[str, Teller]] = {NAMESPACE: "namespace", PARENT_NAMESPACE: "above"}


def parts_of(value: Value) -> Parts:
    """Return the parts of a value, with those apart that a ROS parameter gives."""
    return joined(_part(part) for part in value.template or value.parts)


def local_name(value: Value, handle: Handle, node: str | None) -> LocalName:
    """Return a name for any namespace and node: `/absolute`, `~/private` or relative; code calls the node `node`."""
    space = space_of(handle, node)
    if is_beside_node(value):
        return LocalName(parts_of(value))
    name = parts_of(value) if below_own_name(value) is None else _private(parts_of(value))
    prefix = parts_of(handle.prefix)
    if prefix and not _head(name).startswith(("/", "~")) and not value.text.startswith("/"):
        name = joined([*prefix, "/", *name])
    if not _head(name).startswith("~"):
        return _in_space(name, space)
    private = (_head(name)[1:].lstrip("/"), *name[1:])
    if handle.node is None:
        return _in_space(joined(["~/", *private]), space)
    other = handle.node.text.removeprefix(space).lstrip("/")
    return _in_space(joined([f"{other}/", *private]), space)


def _private(parts: Parts) -> Parts:
    """The same below `~`, without the name of the node in front; as it is where a parameter gives that or the slash."""
    own, below = parts[0], parts[1] if len(parts) > 1 else None
    plainly = isinstance(own, OpenPart) and own.of == "node" and isinstance(below, str)
    return joined(["~/", below.lstrip("/"), *parts[2:]]) if plainly and isinstance(below, str) else parts


def local_parameter(value: Value, handle: Handle, ros: int | None) -> LocalName:
    """Return a name of a parameter: of its node in ROS 2, in any namespace in ROS 1."""
    if ros == 1:
        return local_name(value, handle, None)
    prefix = parts_of(handle.prefix)
    below = bool(prefix) and not _head(prefix).startswith("~")
    return LocalName(joined([*prefix, ".", *parts_of(value)]) if below else parts_of(value))


def _head(parts: Parts) -> str:
    """The text that a name begins with; empty where that is open."""
    return parts[0] if parts and isinstance(parts[0], str) else ""


def _in_space(name: Parts, space: str) -> LocalName:
    """Put a name into the namespace of its node; below one that is not wholly known as it stands."""
    if not space or _head(name).startswith("/"):
        return LocalName(name)
    if "{" in space:
        return LocalName(name if _head(name).startswith("~") else joined([f"{space}/", *name]))
    return LocalName(name, space)


def _part(part: str | Hole | OfParameter) -> str | OpenPart:
    if isinstance(part, str):
        return part
    if isinstance(part, OfParameter):
        return OpenPart("parameter", part.parameter, joined(_part(each) for each in part.default))
    if part.kind == "space":
        return OpenPart(_OF_SPACE[part.label])
    of = "nobody" if part.part else _OF.get(part.kind, "nobody")
    return OpenPart(of, "" if of == "node" else part.part or part.label)
