"""Messages whose receivers need no header, as far as a table tells of these."""

from __future__ import annotations

from collections import defaultdict
from functools import cache

import msgspec

from ecm_extract.lint.workspace import Workspace
from ecm_extract.shipped import shipped_as


class UnstampedReceiver(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A row of the table; its head says what each column means."""

    source: str
    topics: frozenset[str]


class UnstampedReceivers(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The whole table."""

    receiver: tuple[UnstampedReceiver, ...]


@cache
def unstamped_topics() -> frozenset[str]:
    """Return the ends of the names."""
    table = shipped_as("lint/unstamped_receivers.toml", UnstampedReceivers)
    return frozenset(topic for row in table.receiver for topic in row.topics)


class Publishers:
    """What packages publish, by the type of the message.

    Args:
        workspace: of the packages.
    """

    def __init__(self, workspace: Workspace) -> None:
        self._names: dict[tuple[str, str], set[str]] = defaultdict(set)
        for linked in workspace.linked:
            for entry in linked.interfaces:
                if entry.row.writes and entry.type is not None:
                    self._names[linked.module.package, _in_code(entry.type)].add(entry.name)

    def need_no_header(self, package: str, kind: str) -> bool:
        """Whether all that a package publishes of a C++ type goes to receivers that do not look at its header."""
        names = self._names.get((package, kind.replace("::msg::", "::")), set())
        return bool(names) and all("/".join(name.split("/")[-2:]) in unstamped_topics() for name in names)


def _in_code(kind: str) -> str:
    """`geometry_msgs/msg/Twist` -> `geometry_msgs::Twist`."""
    return kind.replace("/msg/", "::").replace("/", "::")
