"""What each of several variables holds that take a value apart."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ecm_parsers.source.expr import Expr, Items, Number

from ecm_extract.infer.held import Held
from ecm_extract.infer.unpacking import taken, unstarred


class HandedOut(NamedTuple):
    """A variable and what it holds of the value."""

    target: Expr
    held: Held


def handed_out(target: Items, held: Held, value: Expr | None) -> Iterator[HandedOut]:
    """Yield each variable of several with what it gets."""
    if held.how == "value" and value is not None:
        for each in taken(target.items, value):
            yield HandedOut(each.target, Held("value", "", each.part, held.env, held.at))
        return
    inner = held.how in {"each", "part"}
    for at, item in enumerate(target.items):
        part = Held("part" if inner else "lost", "", value if inner else None, held.env, held.at)
        part.more = _place(held, at) if inner and _is_plain(target) else None
        yield HandedOut(unstarred(item), part)


def _is_plain(target: Items) -> bool:
    return all(unstarred(item) is item for item in target.items)


def _place(held: Held, at: int) -> Items | None:
    """Where a part stands in an element, from its whole inwards: `(1, 0)` of `b` in `for a, (b, c) in rows`."""
    around = held.more.items if isinstance(held.more, Items) else ()
    return Items((*around, Number(at))) if held.how == "each" or around else None
