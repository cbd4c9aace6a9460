"""Which operations of the standard libraries raise, and when: the table that infer/raising.toml holds."""

from __future__ import annotations

from collections.abc import Mapping, Set
from functools import cache
from typing import Final

import msgspec
from ecm_parsers.source.expr import Call, Constant, Expr, Items, Member, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.walk import children, dotted
from ecm_extract.shipped import shipped


class Operation(msgspec.Struct, frozen=True):
    """Calls that raise under one condition; see infer/raising.toml."""

    names: tuple[str, ...]
    when: str
    kinds: tuple[str, ...]


ABSENT: Final = Operation(("[]",), "absent", ("KeyError", "IndexError"))
BY_NOTHING: Final = Operation(("/", "//", "%"), "zero", ("ZeroDivisionError",))
UNPACKED: Final = Operation(("=",), "unlike", ("ValueError",))
OF_NOTHING: Final = Operation((".",), "nothing", ("AttributeError",))
"""What operators of Python, and its assignments, raise (docs.python.org: expressions, simple statements)."""


@cache
def _rows(language: str, form: str) -> Mapping[str, Operation]:
    rows = msgspec.convert(shipped("infer/raising.toml")[language][form], tuple[Operation, ...])
    return {name: row for row in rows for name in row.names}


def operation(expr: Expr, language: str) -> Operation | None:
    """Return what an expression does that raises under a condition, its parts apart; None for all others."""
    if isinstance(expr, Call):
        return _of_call(expr, language)
    if language != "python":
        return None
    if isinstance(expr, Op) and len(expr.operands) == 2:
        return _of_operator(expr)
    return OF_NOTHING if isinstance(expr, Member) and isinstance(expr.base, Name | Constant) else None


def _of_call(call: Call, language: str) -> Operation | None:
    written = dotted(call.callee) or ""
    found = _rows(language, "call").get(written)
    if found is None and isinstance(call.callee, Member):
        found = _rows(language, "method").get(call.callee.name)
    return found


def _of_operator(expr: Op) -> Operation | None:
    if expr.op == "[]":
        sliced = isinstance(expr.operands[1], Op) and expr.operands[1].op == ":"
        return None if sliced else ABSENT
    return BY_NOTHING if expr.op in BY_NOTHING.names else None


def unpacks(statement: Statement) -> bool:
    """Tell whether a statement takes what it is given apart."""
    return isinstance(statement.target, Items) and statement.kind in {"set", "let"} and statement.value is not None


def has_operation(expr: Expr | None, language: str, named: Set[str]) -> bool:
    """Tell whether an expression does anything that raises under a condition.

    Args:
        expr: the expression.
        language: of its file.
        named: variables that may hold nothing, of which Python cannot take a field.
    """
    if expr is None:
        return False
    found = operation(expr, language)
    if found is not None and (found is not OF_NOTHING or _may_be_nothing(expr, named)):
        return True
    return any(has_operation(part, language, named) for part in children(expr))


def _may_be_nothing(expr: Expr, named: Set[str]) -> bool:
    base = expr.base if isinstance(expr, Member) else None
    return base == Constant("null") or (isinstance(base, Name) and base.id in named)
