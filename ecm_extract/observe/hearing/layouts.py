"""Which message types begin with a header, by their definitions or, without one, by those of the ROS itself."""

from __future__ import annotations

from functools import cache
from typing import Any, Final

_HEADERS: Final = ("std_msgs/Header", "std_msgs/msg/Header", "Header")


def begins_with_header(kind: str, definition: str | None) -> bool:
    """Whether the first field of a type is its header.

    Args:
        kind: `package/msg/Name`.
        definition: text in the form of `.msg`; None or another form when there is none.
    """
    first = _first_field(definition or "")
    if first is not None:
        return first in _HEADERS
    return _known_to_begin(kind)


def _first_field(definition: str) -> str | None:
    """The type of the first field; a constant is none, and IDL has another form."""
    for line in definition.splitlines():
        text = line.partition("#")[0].strip()
        if text.startswith(("=", "module ")):
            return None
        words = text.split()
        if len(words) >= 2 and "=" not in text:
            return words[0]
    return None


@cache
def _known_to_begin(kind: str) -> bool:
    from rosbags.typesys import Stores, get_typestore

    fields: Any = get_typestore(Stores.LATEST).fielddefs.get(kind)
    first = next(iter(fields[1]), None) if fields else None
    return first is not None and first[1][1] == "std_msgs/msg/Header"
