"""All expressions of a statement, and the calls of one."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from operator import attrgetter
from typing import Any, Final

from ecm_parsers.source.expr import (
    Call,
    Comprehension,
    Constant,
    Expr,
    Items,
    Lambda,
    Member,
    Name,
    Number,
    Op,
    Opaque,
    Specialized,
    Table,
    Template,
    Text,
)
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.spelling import last_name

MAX_NODES = 5_000


def expressions(statement: Statement) -> Iterator[tuple[Expr, int]]:
    """Yield each expression with its line: of the innermost call around it, else of the statement."""
    starts = [entry for entry in (statement.target, statement.value) if entry is not None]
    pending: list[tuple[Expr, int]] = [(entry, statement.line) for entry in reversed(starts)]
    for _ in range(MAX_NODES):
        if not pending:
            return
        expr, line = pending.pop()
        if type(expr) is Call and expr.line:
            line = expr.line
        yield expr, line
        if type(expr) not in _LEAVES:
            pending += [(child, line) for child in reversed(children(expr))]


def dotted(expr: Expr) -> str | None:
    """Return `a.b.c` of names and members; None of anything else."""
    if type(expr) is Name or type(expr) is Specialized:
        return expr.id
    parts: list[str] = []
    while type(expr) is Member:
        parts.append(expr.name)
        expr = expr.base
    return ".".join([expr.id, *reversed(parts)]) if type(expr) is Name else None


def last_of(expr: Expr | None) -> str:
    """Return the last part of what a name or a member is called, in either language; empty of anything else."""
    return expr.name if isinstance(expr, Member) else last_name(expr.id) if isinstance(expr, Name) else ""


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


def perhaps_called(expr: Expr | None) -> Iterator[Call]:
    """Yield the calls that a value makes on one side of a choice only: `a.pop() if a else b`."""
    if isinstance(expr, Op) and expr.op in {"?:", "&&", "||"}:
        yield from perhaps_called(expr.operands[0])
        for side in expr.operands[1:]:
            yield from calls_in(side)
        return
    for part in children(expr) if expr is not None else ():
        yield from perhaps_called(part)


def names_in(expr: Expr | None) -> Iterator[str]:
    """Yield the names of an expression."""
    if isinstance(expr, Name):
        yield expr.id
    for part in children(expr) if expr is not None else ():
        yield from names_in(part)


def children(expr: Expr) -> tuple[Expr, ...]:
    """Return the direct parts of an expression."""
    parts = _PARTS.get(type(expr))
    return () if parts is None else parts(expr)


def given_to(call: Call) -> tuple[Expr, ...]:
    """Return the arguments of a call, those that are given by name included."""
    return (*call.args, *[value for _, value in call.keywords]) if call.keywords else call.args


def _of_call(call: Call) -> tuple[Expr, ...]:
    named = [value for _, value in call.keywords]
    return (call.callee, *call.args, *named)


def _of_table(table: Table) -> tuple[Expr, ...]:
    return tuple([part for entry in table.entries for part in entry])


_PARTS: Final[Mapping[type[Expr], Callable[[Any], tuple[Expr, ...]]]] = {
    Call: _of_call,
    Member: lambda member: (member.base,),
    Op: attrgetter("operands"),
    Items: attrgetter("items"),
    Template: attrgetter("parts"),
    Table: _of_table,
    Comprehension: lambda comprehension: (comprehension.element, *comprehension.tests),
}
"""What gives the parts of an expression that has some; asked of each expression of a program."""
_LEAVES = frozenset({Name, Specialized, Text, Number, Constant, Opaque, Lambda})
"""Expressions that hold no other; half of all are."""


def comprehensions(expr: Expr | None) -> Iterator[Comprehension]:
    """Yield the comprehensions in an expression, outer ones first."""
    if expr is None:
        return
    if isinstance(expr, Comprehension):
        yield expr
        yield from comprehensions(expr.element)
        return
    for part in children(expr):
        yield from comprehensions(part)
