"""The same facts with other expressions in place of some."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import msgspec

Change = Callable[[Any], Any]
"""Gives what stands in place of a part of facts; None for what stays, and is looked into."""


def rewritten(part: Any, change: Change) -> Any:
    """Return a fact, or a part of one, with what `change` puts in place of expressions."""
    if isinstance(part, tuple):
        return tuple([rewritten(each, change) for each in part])
    if not isinstance(part, msgspec.Struct):
        return part
    changed = change(part)
    if changed is not None:
        return changed
    given = [(each, getattr(part, each)) for each in part.__struct_fields__]
    return msgspec.structs.replace(part, **{each: rewritten(value, change) for each, value in given})
