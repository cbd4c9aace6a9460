"""Calls that give a variable its value, read as assignments."""

from __future__ import annotations

from collections.abc import Mapping

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Number, Op, Opaque, Text

_PRINTERS = {"snprintf": 2, "std::snprintf": 2, "sprintf": 1, "std::sprintf": 1}
"""Functions that write text to their first argument, and where their format stands."""
_COPYING = frozenset({"strcpy", "strncpy"})
_APPENDING = frozenset({"strcat", "strncat"})
"""Functions of <cstring> that write the text of their second argument, or a number of its characters, to the first."""


def written(call: Call, buffers: Mapping[str, Expr]) -> tuple[Expr, Expr] | None:
    """Return (variable, value) of a call that only assigns.

    The value of a bounded printer is `Op("%", (format, arguments, room))`: the text is cut where its buffer ends.

    Args:
        call: to read.
        buffers: how many characters arrays of them have, by their names.
    """
    if isinstance(call.callee, Member):
        return _reset(call, call.callee)
    name = call.callee.id if isinstance(call.callee, Name) else ""
    if name.removeprefix("std::") in _COPYING | _APPENDING and len(call.args) > 1:
        return _copied(call.args, buffers, name.removeprefix("std::") in _APPENDING)
    at = _PRINTERS.get(name)
    if at is None or len(call.args) <= at or not isinstance(call.args[at], Text):
        return None
    room = tuple([_sized(each, buffers) for each in call.args[1:at]])
    return call.args[0], Op("%", (call.args[at], Items(call.args[at + 1 :]), *room))


def _copied(args: tuple[Expr, ...], buffers: Mapping[str, Expr], behind: bool) -> tuple[Expr, Expr]:
    """A text that is written to a buffer, or behind what stands in it."""
    target, text, *most = args
    room = tuple([Op("+", (_sized(each, buffers), Number(1))) for each in most])
    copy = Op("%", (Text("%s"), Items((text,)), *room))
    return target, Op("+", (target, copy)) if behind else copy


def _sized(expr: Expr, buffers: Mapping[str, Expr]) -> Expr:
    """A number of bytes, with the number of characters of an array in the place of its `sizeof`."""
    if isinstance(expr, Op):
        return Op(expr.op, tuple([_sized(each, buffers) for each in expr.operands]))
    if isinstance(expr, Opaque) and expr.text.startswith("sizeof"):
        return buffers.get(expr.text.removeprefix("sizeof").strip("() "), expr)
    return expr


def _reset(call: Call, callee: Member) -> tuple[Expr, Expr] | None:
    """`pointer.reset(new T(...))`."""
    resets = callee.name == "reset" and len(call.args) == 1 and isinstance(call.args[0], Call)
    return (callee.base, call.args[0]) if resets else None
