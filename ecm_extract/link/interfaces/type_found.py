"""What is found of a type."""

from __future__ import annotations

from typing import Final, NamedTuple


class TypeFound(NamedTuple):
    """A type, and the template parameters in it that callers know."""

    name: str | None
    open: frozenset[str] = frozenset()


UNKNOWN_TYPE: Final = TypeFound(None)
ACTION: Final = "action"
"""The kind of type that a package has in two folders: ROS 1 generates messages of actions."""
