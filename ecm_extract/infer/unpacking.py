"""Which part of a value each variable gets of several that take it apart: `a, *b, c = value`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from ecm_parsers.source.expr import REST, Constant, Expr, Items, Number, Op


class Taken(NamedTuple):
    """A variable and the part that it gets."""

    target: Expr
    part: Expr


def unstarred(target: Expr) -> Expr:
    """Return the variable of a target; `*rest` takes what is left over."""
    return target.operands[0] if isinstance(target, Op) and target.op == REST else target


def taken(targets: Sequence[Expr], value: Expr) -> Iterator[Taken]:
    """Yield each variable with its part: of a display the element, else an element by its number."""
    star = next((at for at, target in enumerate(targets) if unstarred(target) is not target), len(targets))
    shown = value.items if isinstance(value, Items) and _fits(value.items, targets, star) else None
    for at, target in enumerate(targets):
        number = at if at < star else at - len(targets)
        if at != star:
            yield Taken(target, shown[number] if shown is not None else Op("[]", (value, Number(number))))
        else:
            behind = len(targets) - star - 1
            rest = Items(shown[star : len(shown) - behind]) if shown is not None else _slice(value, star, behind)
            yield Taken(unstarred(target), rest)


def _slice(value: Expr, start: int, behind: int) -> Expr:
    """What is left over of a list: `value[1:-2]`."""
    return Op("[]", (value, Op(":", (Number(start), Number(-behind) if behind else Constant("null")))))


def _fits(items: Sequence[Expr], targets: Sequence[Expr], star: int) -> bool:
    """Tell whether a display has an element for each variable, and each of its elements is one."""
    enough = len(items) == len(targets) if star == len(targets) else len(items) >= len(targets) - 1
    return enough and (star == len(targets) or not any(_is_spread(item) for item in items))


def _is_spread(item: Expr) -> bool:
    """Tell whether an element of a display stands for all of another list: `[*names, last]`."""
    return isinstance(item, Op) and item.op == "*" and len(item.operands) == 1
