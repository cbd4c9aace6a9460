"""What subscripts and slices give of data that is known."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ecm_parsers.source.expr import Call, Expr, Member, Number, Op

from ecm_extract.infer.compute import NULL, UNKNOWN


def slice_of(found: Any, bounds: Sequence[Any], kind: type) -> Any:
    """Return a part of a text or list between bounds of which none is unknown."""
    if not isinstance(found, kind) or any(bound is UNKNOWN for bound in bounds):
        return UNKNOWN
    limits = [None if bound is NULL else bound for bound in bounds]
    if not all(limit is None or (isinstance(limit, int) and limit is not False) for limit in limits) or 0 in limits[2:]:
        return UNKNOWN
    return found[slice(*limits)]  # type: ignore[index]


def character_of(text: Any, at: Any) -> Any:
    """Return a character of a text."""
    return text[at] if isinstance(text, str) and -len(text) <= at < len(text) else UNKNOWN


def part_of(parts: object, at: int) -> object:
    """Return an element of a list."""
    listed = isinstance(parts, list | tuple) and -len(parts) <= at < len(parts)
    return parts[at] if isinstance(parts, list | tuple) and listed else UNKNOWN


def taken(expr: Expr) -> tuple[Expr, Expr] | None:
    """Return the list and the index of `list[index]` and `list.at(index)`; None of anything else."""
    if isinstance(expr, Op) and expr.op == "[]" and len(expr.operands) == 2:
        return expr.operands[0], expr.operands[1]
    if not isinstance(expr, Call) or not isinstance(expr.callee, Member) or expr.callee.name != "at":
        return None
    return (expr.callee.base, expr.args[0]) if len(expr.args) == 1 else None


def copied_range(args: Sequence[Expr]) -> Expr | None:
    """Return the container that `{x.begin(), x.end()}` is a copy of; None of anything else."""
    ends = [arg.callee for arg in args if isinstance(arg, Call) and isinstance(arg.callee, Member) and not arg.args]
    if len(args) != 2 or [end.name.removeprefix("c") for end in ends if isinstance(end, Member)] != ["begin", "end"]:
        return None
    first, last = (end.base for end in ends if isinstance(end, Member))
    return first if first == last else None


def steps_on(expr: Expr) -> bool:
    """Tell whether an expression is a place in an array, and no text: `argv + 1`."""
    return isinstance(expr, Op) and expr.op in {"+", "-"} and any(isinstance(part, Number) for part in expr.operands)
