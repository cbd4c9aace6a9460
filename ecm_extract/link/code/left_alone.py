"""Lists and tables of Python of which a function takes no more than what they consist of."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import Call, Constant, Expr, Lambda, Member, Name, Op, Table
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.walk import children, names_in

SPREAD: Final = "**"
"""Name of the keyword that a table of arguments is."""
SPREAD_KEY: Final = Constant("null")
"""Key of a table that another one spreads in its display."""
_READS: Final = frozenset({"get", "items", "keys", "values", "count", "index"})


def is_spread(arg: Expr) -> bool:
    """Tell whether an argument of Python is `*values`, which may be any number of them."""
    return isinstance(arg, Op) and arg.op == "*" and len(arg.operands) == 1


def mentions(step: Statement, name: str) -> bool:
    """Tell whether a statement has a name."""
    return any(name in names_in(part) for part in (step.target, step.value))


def reads_only(step: Statement, name: str) -> bool:
    """Tell whether a statement takes no more of a list or a table than what it consists of."""
    return name not in names_in(step.target) and _only_reads(step.value, name)


def _only_reads(expr: Expr | None, name: str) -> bool:
    if expr is None or expr == Name(name):
        return expr is None
    if isinstance(expr, Lambda):
        return _only_reads(expr.body, name)
    return all(_only_reads(part, name) for part in children(expr) if part not in _read(expr, name))


def _read(expr: Expr, name: str) -> tuple[Expr, ...]:
    """The parts of an expression that take what a list or a table consists of."""
    own = Name(name)
    if isinstance(expr, Op) and (is_spread(expr) or expr.op == "[]") and expr.operands[0] == own:
        return (own,)
    if isinstance(expr, Call):
        given = [*expr.args, *(value for _, value in expr.keywords)]
        spread = (own,) if (SPREAD, own) in expr.keywords and given.count(own) == 1 else ()
        reads = isinstance(expr.callee, Member) and expr.callee.base == own and expr.callee.name in _READS
        return (*spread, expr.callee) if reads else spread
    return (own,) if isinstance(expr, Table) and (SPREAD_KEY, own) in expr.entries else ()
