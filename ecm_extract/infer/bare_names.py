"""The variables that a value is, holds, or is a part of: who changes an object by one of these changes it for all."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ecm_parsers.source.expr import Call, Comprehension, Expr, Items, Member, Name, Op, Table
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.texts import makes_text
from ecm_extract.link.code.walk import given_to, names_in


def bare_names(expr: Expr | None) -> Iterator[Expr]:
    """Yield the variables that an expression is, or that it puts into a list or table as they are."""
    if isinstance(expr, Name | Member):
        yield expr
    elif isinstance(expr, Items):
        for item in expr.items:
            yield from bare_names(item)
    elif isinstance(expr, Table):
        for _, value in expr.entries:
            yield from bare_names(value)
    elif isinstance(expr, Op) and expr.op in {"?:", "||", "&&"}:
        for operand in expr.operands:
            yield from bare_names(operand)
    elif isinstance(expr, Call) and not makes_text(expr):  # `"_".join(names)` keeps nothing of what it gets
        for arg in (*expr.args, *(value for _, value in expr.keywords)):
            yield from bare_names(arg)


def shared_names(expr: Expr | None, body: Sequence[Statement]) -> Iterator[Expr]:
    """Yield the variables that an expression of Python is, holds, or is a part of: `[a]`, `pair[0]`, `table.get(x)`.

    Args:
        expr: the expression.
        body: the statements of its function, with the loops of comprehensions.
    """
    yield from bare_names(expr)
    for part in _parts_shared(expr):
        yield from shared_names(part, body)
    if isinstance(expr, Comprehension):
        loops = [body[at] for at in expr.loops]
        own = {name for loop in loops for name in names_in(loop.target)}
        taken = list(shared_names(expr.element, body))
        yield from taken
        if any(own.intersection(names_in(each)) for each in taken):
            for loop in loops:
                yield from shared_names(loop.value, body)


def _parts_shared(expr: Expr | None) -> Iterable[Expr]:
    """The parts of an expression of which it may be one, or hold parts."""
    if isinstance(expr, Items):
        return (item for item in expr.items if not isinstance(item, Name | Member))
    if isinstance(expr, Member):
        return () if isinstance(expr.base, Name | Member) else (expr.base,)
    if isinstance(expr, Call) and not makes_text(expr):
        receiver = (expr.callee.base,) if isinstance(expr.callee, Member) else ()
        return (*receiver, *(arg for arg in given_to(expr) if not isinstance(arg, Name | Member)))
    if not isinstance(expr, Op):
        return ()
    if expr.op in {"?:", "||", "&&"} or (expr.op == "*" and len(expr.operands) == 1):
        return expr.operands
    if expr.op == "[]":
        return expr.operands[:1]
    listed = expr.op in {"+", "*"} and any(isinstance(each, Items | Comprehension) for each in expr.operands)
    return expr.operands if listed else ()
