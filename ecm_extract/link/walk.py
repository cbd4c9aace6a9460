"""All expressions of a statement, and the calls of one."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_parsers.source.expr import (
    Call,
    Constant,
    Expr,
    Items,
    Lambda,
    Member,
    Name,
    Number,
    Op,
    Opaque,
    Table,
    Template,
    Text,
)
from ecm_parsers.source.facts import Statement

MAX_NODES = 5_000


def expressions(statement: Statement) -> Iterator[tuple[Expr, int]]:
    """Yield each expression with its line: of the innermost call around it, else of the statement."""
    starts = [entry for entry in (statement.target, statement.value) if entry is not None]
    pending: list[tuple[Expr, int]] = [(entry, statement.line) for entry in reversed(starts)]
    for _ in range(MAX_NODES):
        if not pending:
            return
        expr, line = pending.pop()
        if isinstance(expr, Call) and expr.line:
            line = expr.line
        yield expr, line
        pending += [(child, line) for child in reversed(children(expr))]


def dotted(expr: Expr) -> str | None:
    """Return `a.b.c` of names and members; None of anything else."""
    parts: list[str] = []
    while True:
        name = getattr(expr, "name", None)
        base = getattr(expr, "base", None)
        if base is None:
            break
        parts.append(str(name))
        expr = base
    head = getattr(expr, "id", None)
    return ".".join([str(head), *reversed(parts)]) if head is not None else None


def calls_in(expr: Expr | None) -> Sequence[Call]:
    """Return the calls within an expression, inner ones first."""
    if expr is None or type(expr) in _LEAVES:
        return ()
    found: list[Call] = []
    _collect(expr, found)
    return found


def _collect(expr: Expr, found: list[Call]) -> None:
    if type(expr) in _LEAVES:
        return
    for part in children(expr):
        _collect(part, found)
    if isinstance(expr, Call):
        found.append(expr)


def children(expr: Expr) -> tuple[Expr, ...]:
    """Return the direct parts of an expression."""
    if isinstance(expr, Call):
        named = [value for _, value in expr.keywords]
        return (expr.callee, *expr.args, *named)
    if isinstance(expr, Member):
        return (expr.base,)
    if isinstance(expr, Op):
        return expr.operands
    if isinstance(expr, Items):
        return expr.items
    if isinstance(expr, Template):
        return expr.parts
    if isinstance(expr, Table):
        return tuple([part for entry in expr.entries for part in entry])
    return ()


_LEAVES = frozenset({Name, Text, Number, Constant, Opaque, Lambda})
"""Expressions that hold no other; half of all are."""
