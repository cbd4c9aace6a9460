"""The functions that callbacks mean."""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Expr, Lambda, Member, Name, Op


def callback_meant(expr: Expr) -> Name | Lambda | None:
    """The function that `&C::f`, `f`, `std::bind(&C::f, this, _1)`, `boost::bind(...)` or a cast of them means."""
    if isinstance(expr, Op) and expr.op == "&" and isinstance(expr.operands[0], Name):
        return expr.operands[0]
    if isinstance(expr, Name):
        return expr
    if isinstance(expr, Member):
        return Name(expr.name)
    if isinstance(expr, Call) and expr.args:
        first = expr.args[0]
        return first if isinstance(first, Lambda) else callback_meant(first)
    return None
