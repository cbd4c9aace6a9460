"""Launch arguments that a file reads without declaring them, and whether it may read others."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from ecm_parsers.launch.model import Include, LaunchFile, Substitution, Template, Unread

_UNREADABLE = frozenset({"eval", "unknown"})


class Read(msgspec.Struct, frozen=True):
    """An argument that is read with a default of its own, and the line of the action that reads it."""

    name: str
    default: Template
    line: int


def reads(file: LaunchFile) -> Iterator[Read]:
    """Yield what a file reads with a default; a configuration without one must be set by somebody."""
    for line, found in substitutions(file.actions, 0):
        if found.kind == "arg" and len(found.args) > 1:
            name = "".join(part for part in found.args[0] if isinstance(part, str))
            if name and all(isinstance(part, str) for part in found.args[0]):
                yield Read(name, found.args[1], line)


def is_open(file: LaunchFile) -> bool:
    """Whether a file may take arguments that it does not tell.

    In ROS 2 every file that it includes sees what it is given.
    """
    if any(found.kind in _UNREADABLE for _, found in substitutions(file.actions, 0)):
        return True
    return any(isinstance(each, Unread) or (file.ros == 2 and isinstance(each, Include)) for each in _all(file.actions))


def substitutions(value: object, line: int) -> Iterator[tuple[int, Substitution]]:
    """Yield every substitution below a value, with the line of the action that holds it."""
    if isinstance(value, Substitution):
        yield line, value
        value = value.args
    if isinstance(value, tuple | list):
        for item in value:
            yield from substitutions(item, line)
    elif isinstance(value, msgspec.Struct):
        line = getattr(value, "line", line)
        for name in value.__struct_fields__:
            yield from substitutions(getattr(value, name), line)


def _all(value: object) -> Iterator[msgspec.Struct]:
    """Every record below a value."""
    if isinstance(value, tuple | list):
        for item in value:
            yield from _all(item)
    elif isinstance(value, msgspec.Struct):
        yield value
        for name in value.__struct_fields__:
            yield from _all(getattr(value, name))
