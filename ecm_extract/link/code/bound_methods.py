"""Methods that a Python function calls by another name: `p = self.declare_parameter`, then `p("rate", 1.0)`."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping

from ecm_parsers.source.expr import Expr, Member, Name
from ecm_parsers.source.facts import Function, Statement

from ecm_extract.link.code.walk import children


def bound_methods(function: Function) -> Mapping[str, Member]:
    """Return variable -> the method that it holds, where its only assignment says so and the object stays the same."""
    given = Counter(name for statement in function.body for name in _names(statement.target))
    given.update(parameter.name for parameter in function.params)
    given.update(function.shared)
    found = (_bound(statement) for statement in function.body)
    return {name: method for name, method in filter(None, found) if given[name] == 1 and given[_object(method)] <= 1}


def _bound(statement: Statement) -> tuple[str, Member] | None:
    target, value = statement.target, statement.value
    if statement.kind not in {"let", "set"} or not isinstance(target, Name) or not isinstance(value, Member):
        return None
    return (target.id, value) if _object(value) else None


def _object(expr: Expr) -> str:
    """The name at the front of `a.b.c`; empty of what a call or an element gives, which is another each time."""
    while isinstance(expr, Member):
        expr = expr.base
    return expr.id if isinstance(expr, Name) else ""


def _names(target: Expr | None) -> Iterator[str]:
    if isinstance(target, Name):
        yield target.id
    elif target is not None and not isinstance(target, Member):
        for each in children(target):
            yield from _names(each)
