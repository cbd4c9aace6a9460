"""Functions that are declared within another one, of which the calls are all that happens to them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Lambda, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.walk import children

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func


Lends = Callable[[Call, int], bool]
"""Tells whether who gets an argument of a call does nothing with it but call it."""


def only_called(func: Func, inner: Sequence[Func], lends: Lends) -> Iterator[Func]:
    """Yield those that are only called, by name or by who is lent them, and have no copies of what they change.

    Args:
        func: the function around.
        inner: the functions that are declared in it.
        lends: tells which arguments are only called.
    """
    yield from (entry for entry in called_by_name(func, inner, lends) if "mutable" not in entry.fact.traits)


def called_by_name(func: Func, inner: Sequence[Func], lends: Lends = lambda call, index: False) -> Iterator[Func]:
    """Yield those that the function itself calls by name, and that nobody else gets: not even one another.

    Args:
        func: the function around.
        inner: the functions that are declared in it.
        lends: tells which arguments are only called, and so given to nobody.
    """
    names = Counter(entry.fact.name for entry in inner)
    handed = {name for statement in func.fact.body for name in _handed(statement, lends)}
    handed |= {name for entry in inner for statement in entry.fact.body for name in _named(statement)}
    for entry in inner:
        name = entry.fact.name
        if names[name] == 1 and name not in handed:
            yield entry


def function_named(expr: Expr | None) -> str:
    """Return the name of the function that an expression is, empty for what is none."""
    return expr.name if isinstance(expr, Lambda) else expr.id if isinstance(expr, Name) else ""


def _handed(statement: Statement, lends: Lends) -> Iterator[str]:
    """The names in a statement that are no callees; what runs later hands all of its own."""
    value = statement.value
    if statement.deferred or (isinstance(value, Lambda) and statement.target == Name(value.name)):
        yield from _named(statement)
    elif value is not None:
        yield from _not_called(value, lends)


def _not_called(expr: Expr, lends: Lends) -> Iterator[str]:
    if isinstance(expr, Name):
        yield expr.id
    elif isinstance(expr, Lambda):
        yield from (expr.name, *_all(expr))
    called = isinstance(expr, Call) and isinstance(expr.callee, Name)
    lent = _lent(expr, lends) if isinstance(expr, Call) else ()
    for part in children(expr)[1:] if called else children(expr):
        if any(part is each for each in lent):
            yield from _all(part.body) if isinstance(part, Lambda) and part.body is not None else ()
        else:
            yield from _not_called(part, lends)


def _lent(call: Call, lends: Lends) -> list[Expr]:
    """The arguments of a call that may be functions and are only called."""
    given = ((index, arg) for index, arg in enumerate(call.args) if isinstance(arg, Lambda | Name))
    return [arg for index, arg in given if lends(call, index)]


def _named(statement: Statement) -> Iterator[str]:
    if statement.value is not None:
        yield from _all(statement.value)


def _all(expr: Expr) -> Iterator[str]:
    if isinstance(expr, Name):
        yield expr.id
    parts = (expr.body,) if isinstance(expr, Lambda) and expr.body is not None else children(expr)
    for part in parts:
        yield from _all(part)
