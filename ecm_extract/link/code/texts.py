"""What is text, by its form or by what is declared of it: overloads take a node handle before the name."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Template, Text

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.own import own_name
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Func

_SUMS: Final = frozenset({"+", "%"})
_JOINED: Final = _SUMS | {"?:"}
_TYPES: Final = frozenset({"string", "char", "string_view"})


def text_arguments(call: Invocation) -> list[Expr]:
    """Return the arguments that are text for sure, in order; without such a one those that may be."""
    sure = [arg for arg in call.args if is_text(arg, call.func)]
    return sure or [arg for arg in call.args if _may_be(arg, call.func)]


def is_text(expr: Expr, func: Func) -> bool:
    """Tell whether an expression of a function is surely text: by its form, or by what is declared of a variable."""
    written = written_type(expr, func)
    if written:
        return is_text_type(written)
    return isinstance(expr, Text | Template) or (isinstance(expr, Op) and expr.op in _JOINED)


def makes_text(expr: Expr | None) -> bool:
    """Tell whether an expression is a new text, whatever its parts are: a sum with one, what a method of one gives."""
    if isinstance(expr, Op) and expr.op in _SUMS:
        return any(map(makes_text, expr.operands))
    if isinstance(expr, Call) and isinstance(expr.callee, Member):
        return isinstance(expr.callee.base, Text | Template)
    return isinstance(expr, Text | Template)


def _may_be(expr: Expr, func: Func) -> bool:
    return isinstance(expr, Name | Member | Call) and expr != THIS and not written_type(expr, func)


def is_text_type(written: str) -> bool:
    """Tell whether a type as written is one of texts."""
    return last_name(plain(written.removeprefix("const ").rstrip("&* "))) in _TYPES


def written_type(expr: Expr, func: Func) -> str:
    """Return the declared type of a variable, a parameter or a member of the own class; empty where it is not known."""
    if isinstance(expr, Name) and expr.id in func.written_types:
        return func.written_types[expr.id]
    field = func.cls.fields.get(own_name(expr)) if func.cls is not None else None
    return field.type if field is not None else ""
