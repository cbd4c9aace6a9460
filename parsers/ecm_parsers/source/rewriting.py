"""The same facts with other expressions in place of some."""

from __future__ import annotations

from collections.abc import Callable
from operator import is_
from typing import Any

import msgspec

Change = Callable[[Any], Any]
"""Gives what stands in place of a part of facts; None for what stays, and is looked into."""


def rewritten(part: Any, change: Change) -> Any:
    """Return a fact, or a part of one, with what `change` puts in place of expressions; itself without any."""
    if isinstance(part, tuple):
        items = [rewritten(each, change) for each in part]
        return part if all(map(is_, items, part)) else tuple(items)
    if not isinstance(part, msgspec.Struct):
        return part
    changed = change(part)
    if changed is not None:
        return changed
    made = {}
    for name in part.__struct_fields__:
        value = getattr(part, name)
        if isinstance(value, tuple | msgspec.Struct):
            new = rewritten(value, change)
            if new is not value:
                made[name] = new
    return msgspec.structs.replace(part, **made) if made else part
