"""Functions that are declared within another one, of which the calls are all that happens to them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Lambda, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.walk import children

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func


def only_called(func: Func, inner: Sequence[Func]) -> Iterator[Func]:
    """Yield those that are only called by name, and have no copies of variables that they change.

    Args:
        func: the function around.
        inner: the functions that are declared in it.
    """
    yield from (entry for entry in called_by_name(func, inner) if "mutable" not in entry.fact.traits)


def called_by_name(func: Func, inner: Sequence[Func]) -> Iterator[Func]:
    """Yield those that the function itself calls by name, and that nobody else gets: not even one another.

    Args:
        func: the function around.
        inner: the functions that are declared in it.
    """
    names = Counter(entry.fact.name for entry in inner)
    handed = {name for statement in func.fact.body for name in _handed(statement)}
    handed |= {name for entry in inner for statement in entry.fact.body for name in _named(statement)}
    for entry in inner:
        name = entry.fact.name
        if names[name] == 1 and name not in handed:
            yield entry


def _handed(statement: Statement) -> Iterator[str]:
    """The names in a statement that are no callees; what runs later hands all of its own."""
    value = statement.value
    if statement.deferred or (isinstance(value, Lambda) and statement.target == Name(value.name)):
        yield from _named(statement)
    elif value is not None:
        yield from _not_called(value)


def _not_called(expr: Expr) -> Iterator[str]:
    if isinstance(expr, Name):
        yield expr.id
    elif isinstance(expr, Lambda):
        yield from (expr.name, *_all(expr))
    called = isinstance(expr, Call) and isinstance(expr.callee, Name)
    for part in children(expr)[1:] if called else children(expr):
        yield from _not_called(part)


def _named(statement: Statement) -> Iterator[str]:
    if statement.value is not None:
        yield from _all(statement.value)


def _all(expr: Expr) -> Iterator[str]:
    if isinstance(expr, Name):
        yield expr.id
    parts = (expr.body,) if isinstance(expr, Lambda) and expr.body is not None else children(expr)
    for part in parts:
        yield from _all(part)
