"""Calls that give a variable its value, read as assignments."""

from __future__ import annotations

from collections.abc import Mapping

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Number, Op, Opaque, Text

_PRINTERS = {"snprintf": 2, "std::snprintf": 2, "sprintf": 1, "std::sprintf": 1}
"""Functions that write text to their first argument, and where their format stands."""
_COPYING = frozenset({"strcpy", "strncpy"})
_APPENDING = frozenset({"strcat", "strncat"})
"""Functions of <cstring> that write the text of their second argument, or a number of its characters, to the first."""
_BOOST = ("boost::algorithm::", "boost::")
_IN_PLACE = frozenset(
    {"replace_all", "replace_first", "erase_all", "to_lower", "to_upper", "trim", "trim_left", "trim_right"}
)
"""String algorithms of Boost that change their first argument: what they make of it the same with `_copy` gives."""
_CASES = {"tolower": "to_lower", "toupper": "to_upper"}
_COPY = "boost::algorithm::%s_copy"


def written(call: Call, buffers: Mapping[str, Expr]) -> tuple[Expr, Expr] | None:
    """Return (variable, value) of a call that only assigns.

    The value of a bounded printer is `Op("%", (format, arguments, room))`: the text is cut where its buffer ends.

    Args:
        call: to read.
        buffers: how many characters arrays of them have, by their names.
    """
    if isinstance(call.callee, Member):
        return _reset(call, call.callee) or _erased(call, call.callee)
    name = call.callee.id if isinstance(call.callee, Name) else ""
    changed = _changed(name, call.args)
    if changed is not None:
        return changed
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


def _changed(name: str, args: tuple[Expr, ...]) -> tuple[Expr, Expr] | None:
    """A text that a call changes: `boost::replace_all(text, "-", "_")`, `std::replace` of all of it and the like."""
    last = name.rpartition("::")[2]
    if last in _IN_PLACE and name.removesuffix(last) in _BOOST and args:
        return args[0], _made(last, args)
    whole = _whole(args[:2]) if name in {"std::replace", "std::transform"} and len(args) == 4 else None
    if whole is None:
        return None
    if name == "std::replace":
        return whole, _made("replace_all", (whole, *args[2:]))
    case = _CASES.get(args[3].id.rpartition("::")[2]) if isinstance(args[3], Name) else None
    return (whole, _made(case, (whole,))) if case and args[2] == args[0] else None


def _erased(call: Call, callee: Member) -> tuple[Expr, Expr] | None:
    """`text.erase(std::remove(text.begin(), text.end(), '/'), text.end())`."""
    first = call.args[0] if callee.name == "erase" and len(call.args) == 2 else None
    removes = isinstance(first, Call) and first.callee == Name("std::remove") and len(first.args) == 3
    if not isinstance(first, Call) or not removes or _whole(first.args[:2]) != callee.base:
        return None
    return callee.base, _made("erase_all", (callee.base, first.args[2]))


def _whole(ends: tuple[Expr, ...]) -> Expr | None:
    """What `text.begin()` and `text.end()` are the ends of."""
    found = [end.callee for end in ends if isinstance(end, Call) and isinstance(end.callee, Member) and not end.args]
    same = len(found) == len(ends) == 2 and found[0].base == found[1].base
    return found[0].base if same and [each.name for each in found] == ["begin", "end"] else None


def _made(name: str, args: tuple[Expr, ...]) -> Call:
    return Call(Name(_COPY % name), args, (), (), 0)
