"""Which list the elements of another one, or parts of them, are of: `sorted(a)`, `enumerate(a)`, `zip(a, b)`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Name, Number

REORDERING: Final = frozenset({"list", "tuple", "sorted", "reversed", "set", "frozenset"})
"""Calls of Python that have all elements of one list, in any order."""


class Column(NamedTuple):
    """A list, and where in its elements a part stands; empty for the elements themselves."""

    listed: Expr
    place: tuple[int, ...]


def column(listed: Expr, place: Sequence[int]) -> Column | None:
    """Return the list of which each part is an element, as far as calls tell; None where a part is counted or made."""
    while isinstance(listed, Call) and isinstance(listed.callee, Name):
        inner = _argument(listed, listed.callee.id, place)
        if inner is None:
            break
        if inner.listed is None:
            return None
        listed, place = inner.listed, inner.place
    return Column(listed, tuple(place))


def place_of(written: Expr | None) -> tuple[int, ...] | None:
    """Return where a part stands in an element, as `Held.more` writes it; None where it does not say."""
    if not isinstance(written, Items):
        return None
    numbers = [each.value for each in written.items if isinstance(each, Number)]
    found = tuple([number for number in numbers if isinstance(number, int)])
    return found if len(found) == len(written.items) else None


def indexed(numbers: Expr | None) -> Expr | None:
    """Return the list whose indices are `range(len(names))`; None of other expressions."""
    counted = _only_argument(numbers, "range")
    return _only_argument(counted, "len")


def _only_argument(expr: Expr | None, function: str) -> Expr | None:
    is_call = isinstance(expr, Call) and expr.callee == Name(function) and not expr.keywords
    return expr.args[0] if is_call and isinstance(expr, Call) and len(expr.args) == 1 else None


class _Inner(NamedTuple):
    listed: Expr | None
    place: tuple[int, ...]


def _argument(call: Call, name: str, place: Sequence[int]) -> _Inner | None:
    """The argument whose elements a call of Python gives; None of other calls."""
    if name in REORDERING and len(call.args) == 1:
        return _Inner(call.args[0], tuple(place))
    if name == "enumerate" and call.args and place:
        return _Inner(call.args[0] if place[0] == 1 else None, tuple(place[1:]))
    if name == "zip" and place and place[0] < len(call.args):
        return _Inner(call.args[place[0]], tuple(place[1:]))
    return None
