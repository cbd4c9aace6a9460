"""The roles of endpoints: what each provides, requires, takes and gives. A new role is a row."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Literal, TypeAlias

import msgspec


class RoleKind(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What an endpoint of a role is to others; empty text where there is nothing.

    Attributes:
        provides: kind of the name that others see. facet: direction of a topic.
        peer: role on the other side.
        channel: what it is joined to in the graph; None for parameters.
        value: whether it is a value that its node keeps, with a type and default of its own.
        transform: whether what it carries are transforms between frames. places: kind of name whose place it tells.
        sends: whether data, or a request, goes from the module to the channel.
        use: what it requires of others. joins: what it requires of others of one launch.
        verb: what it does with its type there. does: what it does with the name.
        short: what it is called where room is short.
        shape: of the interface file of its type; empty for what has no type of its own.
        takes, gives: sections of its type that come to the module and go out of it.
        mismatch: rule that tells of two sides whose types differ. near: of a name that almost fits; of who gives.
        behind: role under which the graph shows it, and client libraries may make it.
        timing: how a module that has it is called, as contracts say it. ends: how what it gives comes.
        awaited: word of a precondition of whoever waits until it is there.
    """

    provides: str = ""
    facet: str = ""
    peer: str = ""
    channel: str | None = None
    value: bool = False
    transform: bool = False
    places: str = ""
    sends: bool = False
    use: str = ""
    joins: str = ""
    verb: str = ""
    does: str = ""
    short: str = ""
    shape: Literal["", "msg", "srv", "action"] = ""
    takes: str = ""
    gives: str = ""
    mismatch: str = ""
    near: str = ""
    behind: str = ""
    timing: str = ""
    ends: str = ""
    awaited: str = ""

    @property
    def writes(self) -> bool:
        """Whether it gives what nobody asks for."""
        return bool(self.gives) and not self.takes

    @property
    def reads(self) -> bool:
        """Whether it takes what others give and answers nothing."""
        return bool(self.takes) and not self.gives

    @property
    def streams(self) -> bool:
        """Whether messages go one way."""
        return self.writes or self.reads

    @property
    def serves(self) -> bool:
        """Whether it answers what others ask."""
        return bool(self.takes and self.gives)

    @property
    def calls(self) -> bool:
        """Whether it asks, and others answer."""
        return bool(self.shape) and not self.takes and not self.gives

    @property
    def hears_transforms(self) -> bool:
        """Whether it asks for a transform between frames."""
        return self.transform and not self.sends

    @property
    def tells_transforms(self) -> bool:
        """Whether it says where a frame is."""
        return self.transform and self.sends


@cache
def roles() -> dict[str, RoleKind]:
    """Return the roles by their word in contracts."""
    text = resources.files("ecm_checker.hub").joinpath("roles.toml").read_text("utf-8")
    return msgspec.convert(tomllib.loads(text), dict[str, RoleKind])


if TYPE_CHECKING:
    Role: TypeAlias = str
else:
    Role = Literal[tuple(roles())]
"""The word of a role in contracts: any row, so that readers and JSON Schemas know a new one."""


@cache
def served_roles() -> tuple[Role, ...]:
    """Return the roles whose names others call: servers of services and actions."""
    return tuple(role for role, row in roles().items() if row.serves)


@cache
def writing_roles() -> tuple[Role, ...]:
    """Return the roles that give messages to whoever listens."""
    return tuple(role for role, row in roles().items() if row.writes)


@cache
def channel_kinds() -> tuple[str, ...]:
    """Return what joins endpoints in the graph, in the order of the rows."""
    return tuple(dict.fromkeys(row.channel for row in roles().values() if row.channel is not None))


def linked_roles() -> Iterator[tuple[Role, Role]]:
    """Yield each role that gives or answers with the one on its other side."""
    yield from ((role, row.peer) for role, row in roles().items() if row.gives and row.peer)


@cache
def endpoint_kinds() -> frozenset[str]:
    """Return the kinds of names that endpoints have for others; a launch file can remap them."""
    return frozenset(row.provides for row in roles().values() if row.provides and not row.value)


@cache
def value_kinds() -> frozenset[str]:
    """Return the kinds of names that values of nodes have."""
    return frozenset(row.provides for row in roles().values() if row.provides and row.value)


@cache
def module_kinds() -> frozenset[str]:
    """Return the kinds of all names that a module has for others by its endpoints and values."""
    return endpoint_kinds() | value_kinds()


@cache
def endpoint_uses() -> frozenset[str]:
    """Return the uses by which endpoints require a name of others."""
    return frozenset(row.use for row in roles().values() if row.use)


@cache
def asking_uses() -> tuple[str, ...]:
    """Return the uses of endpoints that get nothing where the name is another one."""
    return tuple(row.use for row in roles().values() if row.use and not row.writes)


@cache
def joining_uses() -> frozenset[str]:
    """Return the uses by which endpoints require a name of others of one launch."""
    return frozenset(row.joins for row in roles().values() if row.joins)
