"""Which list the elements of another one, or parts of them, are of: `sorted(a)`, `enumerate(a)`, `zip(a, b)`."""

from __future__ import annotations

from typing import Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Name, Number

_REORDERING: Final = frozenset({"list", "tuple", "sorted", "reversed", "set", "frozenset"})
"""Calls of Python that have all elements of one list, in any order."""


class Column(NamedTuple):
    """A list, and where in its elements a part stands; empty for the elements themselves."""

    listed: Expr
    place: tuple[int, ...]


def column(listed: Expr, place: tuple[int, ...]) -> Column:
    """Return the list of which each part is an element, or a part of one, as far as calls tell."""
    while (inner := _argument(listed, place)) is not None:
        listed, place = inner
    return Column(listed, place)


def _argument(listed: Expr, place: tuple[int, ...]) -> Column | None:
    """The argument of a call of Python of which the elements are parts of its elements; None of other expressions."""
    if not isinstance(listed, Call) or not isinstance(listed.callee, Name) or not listed.args:
        return None
    name, first, rest = listed.callee.id, place[:1], place[1:]
    if name in _REORDERING:
        return Column(listed.args[0], place) if len(listed.args) == 1 else None
    if name == "enumerate":
        return Column(listed.args[0], rest) if first == (1,) else None
    return Column(listed.args[first[0]], rest) if name == "zip" and first and first[0] < len(listed.args) else None


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
