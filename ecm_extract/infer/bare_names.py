"""The variables that a value is, holds, or is a part of: who changes an object by one of these changes it for all."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op, Table

from ecm_extract.link.code.texts import makes_text


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


def shared_names(expr: Expr | None) -> Iterator[Expr]:
    """Yield the variables that an expression of Python is, holds, or is a part of: `[a]`, `pair[0]`, `table.get(x)`."""
    yield from bare_names(expr)
    if isinstance(expr, Op) and expr.op in {"+", "*"}:
        for display in expr.operands:
            yield from bare_names(display) if isinstance(display, Items) else ()
    elif isinstance(expr, Op) and expr.op in {"[]", "?:", "||", "&&"}:
        for operand in expr.operands[: 1 if expr.op == "[]" else None]:
            yield from shared_names(operand)
    elif isinstance(expr, Call) and isinstance(expr.callee, Member):
        yield from shared_names(expr.callee.base)
