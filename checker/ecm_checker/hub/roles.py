"""The roles of endpoints: what each provides, requires, takes and gives. A new role is a row."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Literal

import msgspec

from ecm_checker.contract import Role

ChannelKind = Literal["topic", "service", "action"]


class RoleKind(msgspec.Struct, frozen=True, kw_only=True):
    """What an endpoint of a role is to others; empty text where there is nothing.

    Attributes:
        provides: kind of the name that others see. facet: direction of a topic.
        peer: role on the other side.
        channel: what it is joined to in the graph; None for parameters.
        sends: whether data, or a request, goes from the module to the channel.
        use: what it requires of others. joins: what it requires of others of one launch.
        verb: what it does with its type there.
        shape: of the interface file of its type; empty for what has no type of its own.
        takes, gives: sections of its type that come to the module and go out of it.
    """

    provides: str = ""
    facet: str = ""
    peer: Role | Literal[""] = ""
    channel: ChannelKind | None = None
    sends: bool = False
    use: str = ""
    joins: str = ""
    verb: str = ""
    shape: Literal["", "msg", "srv", "action"] = ""
    takes: str = ""
    gives: str = ""


@cache
def roles() -> Mapping[Role, RoleKind]:
    """Return the roles by their word in contracts."""
    text = resources.files("ecm_checker.hub").joinpath("roles.toml").read_text("utf-8")
    return msgspec.convert(tomllib.loads(text), dict[Role, RoleKind])


@cache
def served_roles() -> tuple[Role, ...]:
    """Return the roles whose names others call: servers of services and actions."""
    return tuple(role for role, row in roles().items() if row.takes and row.gives)
