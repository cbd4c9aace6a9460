"""What the values that statements give are made of, as they are written."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Call, Expr, Items, Name, Op

from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.containers import makes_tuple
from ecm_extract.link.code.walk import calls_in

_REFERRING: Final = frozenset({Name("std::ref"), Name("std::reference_wrapper")})
"""en.cppreference.com, std::ref: who has what it gives may change what it is given."""


def arguments(value: Expr | None) -> tuple[Expr, ...]:
    """Return what a call is given; nothing of anything else."""
    return value.args if isinstance(value, Call) else ()


def referred(value: Expr | None) -> Iterator[Expr]:
    """Yield the variables that others get a reference to: `std::bind(f, std::ref(x))`, `std::pair<T &, int>(x, 1)`."""
    for call in calls_in(value) if value is not None else ():
        if call.callee in _REFERRING or any(each.endswith("&") for each in call.types):
            yield from call.args


def addressed_in(value: Expr | None) -> Iterator[Expr]:
    """Yield what a value is the address of, or has the address of in its braces: `{&x, &y}`."""
    inside = [item for entry in braces(value) for item in entry.items]
    for each in (value, *inside):
        if isinstance(each, Op) and is_address(each):
            yield each.operands[0]


def of_maker(value: Expr | None, python: bool) -> Expr | None:
    """Return the values that a pair or tuple of C++ is made of; anything else as it is."""
    return Items(value.args) if isinstance(value, Call) and not python and makes_tuple(value) else value


def braces(value: Expr | None) -> list[Items]:
    """Return the lists in braces that an object is made from: its own, or those of its construction."""
    given = value.args if isinstance(value, Call) else (value,)
    return [entry for entry in given if isinstance(entry, Items)]
