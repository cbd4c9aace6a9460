"""Types that no interface file declares, and the messages that they are sent as."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

import msgspec

from ecm_extract.link.code.spelling import template_arguments
from ecm_extract.shipped import shipped_as


class SentAs(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One row: the message, or which template argument names it; `ros` is the version that has it."""

    ros: int
    message: str = ""
    argument: int = 0


def wrapped(path: str) -> int | None:
    """Return which argument names the message of a class that a call of Python makes; None of other calls."""
    row = _rows().get(path)
    return row.argument if row is not None and not row.message else None


@cache
def _rows() -> Mapping[str, SentAs]:
    return shipped_as("link/interfaces/sent_as.toml", dict[str, SentAs])


def sent_as(bare: str, written: str, ros: int | None) -> str:
    """Return the message that a type is sent as: `package/msg/Name`, or a type as written; empty for others.

    Args:
        bare: qualified name of the type.
        written: the type with its template arguments.
        ros: whose rules hold.
    """
    row = _rows().get(bare)
    if row is None or ros not in {row.ros, None}:
        return ""
    if row.message:
        return row.message
    given = template_arguments(written)
    return given[row.argument] if row.argument < len(given) else ""
