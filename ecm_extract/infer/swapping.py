"""Variables of C++ that change places: `std::swap(a, b)`, `a.swap(b)`. Source: en.cppreference.com, std::swap."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Member, Name

from ecm_extract.infer.effect import Effect

if TYPE_CHECKING:
    from ecm_extract.infer.effects import Effects


def swaps(call: Call, effects: Effects) -> bool:
    """Tell whether a call lets two variables change places, and is none of a function of the tree."""
    callee = call.callee
    name = callee.name if isinstance(callee, Member) else callee.id if isinstance(callee, Name) else ""
    given = 1 if isinstance(callee, Member) else 2
    return not effects.python and name in {"swap", "std::swap"} and len(call.args) == given


def swapped(call: Call, effects: Effects) -> Iterator[Effect]:
    """Yield what becomes of both at once; who is only a part of something leaves that unknown."""
    both = [call.callee.base, *call.args] if isinstance(call.callee, Member) else list(call.args)
    keys = [effects.key(arg) for arg in both]
    if all(keys) and not any("." in key[1:] for key in keys):
        yield Effect("swapped", keys[0], call, keys[1])
        yield Effect("swapped", keys[1], call, keys[0])
        return
    yield from (Effect("lost", root, call) for arg in both if (root := effects.root(arg)))
