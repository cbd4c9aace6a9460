"""Calls that give a variable its value, read as assignments."""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op, Text

_PRINTERS = {"snprintf": 2, "std::snprintf": 2, "sprintf": 1, "std::sprintf": 1}
"""Functions that write text to their first argument, and where their format stands."""


def written(call: Call) -> tuple[Expr, Expr] | None:
    """Return (variable, value) of a call that only assigns."""
    if isinstance(call.callee, Member):
        return _reset(call, call.callee)
    at = _PRINTERS.get(call.callee.id) if isinstance(call.callee, Name) else None
    if at is None or len(call.args) <= at or not isinstance(call.args[at], Text):
        return None
    return call.args[0], Op("%", (call.args[at], Items(call.args[at + 1 :])))


def _reset(call: Call, callee: Member) -> tuple[Expr, Expr] | None:
    """`pointer.reset(new T(...))`."""
    resets = callee.name == "reset" and len(call.args) == 1 and isinstance(call.args[0], Call)
    return (callee.base, call.args[0]) if resets else None
