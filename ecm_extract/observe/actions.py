"""Actions, which the graph shows as topics (ROS 1) or as hidden services and topics (ROS 2), as one endpoint each."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Final

from ecm_extract.observe.model import Endpoint

_HIDDEN: Final = "/_action/"
_HIDDEN_ROLES: Final = {"service_server": "action_server", "service_client": "action_client"}
# ROS 1, actionlib: what a server does with each topic of an action; a client does the opposite.
_SERVER: Final = {
    "goal": "subscriber",
    "cancel": "subscriber",
    "status": "publisher",
    "feedback": "publisher",
    "result": "publisher",
}
_OPPOSITE: Final = {"publisher": "subscriber", "subscriber": "publisher"}


def with_actions(endpoints: Iterable[Endpoint], ros: int) -> tuple[Endpoint, ...]:
    """Return endpoints with those of each action made one."""
    return tuple(_ros1(endpoints) if ros == 1 else _ros2(endpoints))


def _ros2(endpoints: Iterable[Endpoint]) -> Iterator[Endpoint]:
    """`NAME/_action/send_goal` tells server, client and type; the other hidden names say nothing more."""
    for end in endpoints:
        name, hidden, part = end.name.partition(_HIDDEN)
        if not hidden:
            yield end
        elif part == "send_goal" and end.role in _HIDDEN_ROLES:
            kind = (end.type or "").removesuffix("_SendGoal").replace("/srv/", "/action/") or None
            yield Endpoint(_HIDDEN_ROLES[end.role], name, kind, end.node)


def _ros1(endpoints: Iterable[Endpoint]) -> Iterator[Endpoint]:
    """A node with all five topics of an action below one name, in the directions of a server or of a client."""
    groups: defaultdict[tuple[str | None, str], dict[str, Endpoint]] = defaultdict(dict)
    plain = []
    for end in endpoints:
        name, _, part = end.name.rpartition("/")
        if part in _SERVER and end.role in _OPPOSITE and name:
            groups[end.node, name].setdefault(f"{part} {end.role}", end)
        else:
            plain.append(end)
    yield from plain
    for (node, name), ends in groups.items():
        yield from _folded(node, name, ends)


def _folded(node: str | None, name: str, ends: dict[str, Endpoint]) -> Iterator[Endpoint]:
    """One node may be server and client of an action at once."""
    left = dict(ends)
    for role, direction in (("action_server", _SERVER), ("action_client", _reversed())):
        keys = [f"{part} {way}" for part, way in direction.items()]
        if all(key in ends for key in keys):
            result = ends[f"result {direction['result']}"].type
            yield Endpoint(role, name, _action_type(result), node)
            for key in keys:
                left.pop(key, None)
    yield from left.values()


def _reversed() -> dict[str, str]:
    return {part: _OPPOSITE[way] for part, way in _SERVER.items()}


def _action_type(result: str | None) -> str | None:
    if result is None or not result.endswith("ActionResult"):
        return None
    return result.removesuffix("ActionResult").replace("/msg/", "/action/")
