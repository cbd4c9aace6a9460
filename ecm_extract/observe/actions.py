"""Actions, which the graph shows as topics (ROS 1) or as hidden services and topics (ROS 2), as one endpoint each."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Final

from ecm_checker.hub.roles import roles

from ecm_extract.observe.model import Endpoint

_HIDDEN: Final = "/_action/"
# ROS 1, actionlib: what a server of an action listens to and what it tells; a client does the opposite.
_HEARD: Final = ("goal", "cancel")
_RESULT: Final = "result"
_TOLD: Final = ("status", "feedback", _RESULT)
_Way = tuple[str, bool]
"""A topic of an action by its last name, and whether a node writes to it."""


def with_actions(endpoints: Iterable[Endpoint], ros: int) -> tuple[Endpoint, ...]:
    """Return endpoints with those of each action made one."""
    return tuple(_ros1(endpoints) if ros == 1 else _ros2(endpoints))


def _ros2(endpoints: Iterable[Endpoint]) -> Iterator[Endpoint]:
    """`NAME/_action/send_goal` tells server, client and type; the other hidden names say nothing more."""
    for end in endpoints:
        name, hidden, part = end.name.partition(_HIDDEN)
        if not hidden:
            yield end
        elif part == "send_goal":
            kind = (end.type or "").removesuffix("_SendGoal").replace("/srv/", "/action/") or None
            yield from (Endpoint(role, name, kind, end.node) for role, row in roles().items() if row.behind == end.role)


def _ros1(endpoints: Iterable[Endpoint]) -> Iterator[Endpoint]:
    """A node with all five topics of an action below one name, in the directions of a server or of a client."""
    groups: defaultdict[tuple[str | None, str], dict[_Way, Endpoint]] = defaultdict(dict)
    plain = []
    for end in endpoints:
        name, _, part = end.name.rpartition("/")
        if part in {*_HEARD, *_TOLD} and end.row.streams and name:
            groups[end.node, name].setdefault((part, end.row.writes), end)
        else:
            plain.append(end)
    yield from plain
    for (node, name), ends in groups.items():
        yield from _folded(node, name, ends)


def _folded(node: str | None, name: str, ends: dict[_Way, Endpoint]) -> Iterator[Endpoint]:
    """One node may be server and client of an action at once."""
    left = dict(ends)
    for role, row in roles().items():
        ways = _ways(server=row.serves) if row.behind else ()
        if ways and all(way in ends for way in ways):
            yield Endpoint(role, name, _action_type(ends[_RESULT, row.serves].type), node)
            for way in ways:
                left.pop(way, None)
    yield from left.values()


def _ways(server: bool) -> tuple[_Way, ...]:
    return (*((part, not server) for part in _HEARD), *((part, server) for part in _TOLD))


def _action_type(result: str | None) -> str | None:
    if result is None or not result.endswith("ActionResult"):
        return None
    return result.removesuffix("ActionResult").replace("/msg/", "/action/")
