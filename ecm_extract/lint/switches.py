"""Endpoints that a parameter of their node switches off where a launch file starts it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from typing import NamedTuple

from ecm_checker.contract import Interface
from ecm_checker.hub.condition import Condition

from ecm_extract.lint.workspace import Workspace
from ecm_extract.system.node_model import Endpoint, SystemNode


class _Line(NamedTuple):
    """Where an endpoint of a role is made."""

    role: str
    path: str
    line: int


class Switches:
    """Which endpoints of the sources are made under conditions.

    Args:
        workspace: whose nodes are asked for.
    """

    def __init__(self, workspace: Workspace) -> None:
        self._made: dict[_Line, list[tuple[Condition, ...]]] = defaultdict(list)
        for linked in workspace.linked:
            for entry in linked.interfaces:
                self._add(entry)

    def _add(self, entry: Interface) -> None:
        for line in entry.evidence[:1]:
            self._made[_Line(entry.role, line.path, line.line)].append(entry.when)

    def is_off(self, entry: Endpoint, node: SystemNode) -> bool:
        """Whether a node, as it is started, does not make an endpoint: a parameter of it says so each time."""
        values = _values(node)
        ways = self._made.get(_Line(entry.role, entry.place.path, entry.place.line), [])
        return bool(ways) and all(
            any(each.holds(values, "parameter") is False for each in conditions) for conditions in ways
        )


def _values(node: SystemNode) -> Mapping[str, str]:
    """What parameters of a node are here, as far as they are known."""
    return {each.name: str(each.value) for each in node.parameters if isinstance(each.value, bool | int | str)}
