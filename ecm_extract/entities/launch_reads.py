"""Launch arguments that a file reads without declaring them, and whether it may read others."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from ecm_parsers.launch.model import Include, LaunchFile, SetConfiguration, Unread
from ecm_parsers.launch.templates import Found, all_actions, plain_text, substitutions
from ecm_parsers.template import Template

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
    included = file.ros == 2 and any(isinstance(each, Include) for each in _all(file.actions))
    return (
        included
        or any(each.substitution.kind in _UNREADABLE for each in substitutions(file.actions))
        or _has_unread(file)
    )


def is_partly_read(file: LaunchFile) -> bool:
    """Whether a file itself, without what it includes, names or reads values that nothing tells."""
    names = (each.name for each in all_actions(file.actions) if isinstance(each, SetConfiguration))
    return any(map(_is_computed, substitutions(file.actions))) or None in map(plain_text, names) or _has_unread(file)


def _is_computed(found: Found) -> bool:
    part = found.substitution
    return part.kind in _UNREADABLE or (part.kind == "arg" and (not part.args or plain_text(part.args[0]) is None))


def _has_unread(file: LaunchFile) -> bool:
    return any(isinstance(each, Unread) for each in _all(file.actions))


def _all(value: object) -> Iterator[msgspec.Struct]:
    """Every record below a value."""
    if isinstance(value, tuple | list):
        for item in value:
            yield from _all(item)
    elif isinstance(value, msgspec.Struct):
        yield value
        for name in value.__struct_fields__:
            yield from _all(getattr(value, name))
