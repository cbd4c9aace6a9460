"""Launch arguments that a file reads without declaring them, and whether it may read others."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from ecm_parsers.launch.model import Include, LaunchFile, Template, Unread
from ecm_parsers.launch.templates import plain_text, substitutions

_UNREADABLE = frozenset({"eval", "unknown"})


class Read(msgspec.Struct, frozen=True):
    """An argument that is read with a default of its own, and the line of the action that reads it."""

    name: str
    default: Template
    line: int


def reads(file: LaunchFile) -> Iterator[Read]:
    """Yield what a file reads with a default; a configuration without one must be set by somebody."""
    for each in substitutions(file.actions):
        found = each.substitution
        if found.kind == "arg" and len(found.args) > 1:
            name = plain_text(found.args[0])
            if name:
                yield Read(name, found.args[1], each.line)


def is_open(file: LaunchFile) -> bool:
    """Whether a file may take arguments that it does not tell.

    In ROS 2 every file that it includes sees what it is given.
    """
    if any(each.substitution.kind in _UNREADABLE for each in substitutions(file.actions)):
        return True
    return any(isinstance(each, Unread) or (file.ros == 2 and isinstance(each, Include)) for each in _all(file.actions))


def _all(value: object) -> Iterator[msgspec.Struct]:
    """Every record below a value."""
    if isinstance(value, tuple | list):
        for item in value:
            yield from _all(item)
    elif isinstance(value, msgspec.Struct):
        yield value
        for name in value.__struct_fields__:
            yield from _all(getattr(value, name))
