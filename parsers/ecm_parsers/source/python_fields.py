"""Fields of Python that are given, or asked for, by calls and tables: as the statements that do the same.

`setattr(a, "b", c)`, `a.__dict__["b"] = c`, `vars(a)["b"] = c` are `a.b = c`. Of a name that is no literal the field is
an element of `a.__dict__`. `exec(text)` may give any field of the object at hand something.
Source: docs.python.org, built-in functions and `object.__dict__`.
"""

from __future__ import annotations

from typing import Final, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Opaque, Text

FIELDS: Final = "__dict__"
_CLASS: Final = "__class__"
_GIVES: Final = "__setattr__"
_TAKES: Final = "__delattr__"
_RUNS: Final = (Name("exec"), Name("execfile"))
_GIVING: Final = frozenset({"setattr", "delattr", _GIVES, _TAKES, *(each.id for each in _RUNS)})
RUN: Final = Op("[]", (Member(THIS, FIELDS), Opaque("exec")))
"""What code may give something that stands in a text."""


class Given(NamedTuple):
    """What a call gives: the field, and its value, None where the field is taken away."""

    target: Expr
    value: Expr | None


def gives_field(callee: str) -> bool:
    """Tell whether a function, as it is written, may be one that gives an object a field, or takes one away."""
    return callee.rpartition(".")[2] in _GIVING


def given_by(expr: Expr) -> Given | None:
    """Return what a call gives a field; None of other expressions."""
    if not isinstance(expr, Call) or expr.keywords:
        return None
    args = expr.args
    callee = expr.callee
    if callee in _RUNS:
        return Given(RUN, expr)
    if isinstance(callee, Member) and callee.name in {_GIVES, _TAKES}:
        named = {_GIVES: 2, _TAKES: 1}[callee.name]
        own = isinstance(callee.base, Call) and callee.base.callee == Name("super")
        args = (THIS if own else callee.base, *args) if len(args) == named else args
    elif callee not in (Name("setattr"), Name("delattr")):
        return None
    if len(args) not in {2, 3}:
        return None
    return Given(field_of(Member(args[0], FIELDS), args[1]), args[2] if len(args) == 3 else None)


def field_of(base: Expr, index: Expr) -> Expr:
    """Return an element of a table: of the fields of an object the field."""
    if isinstance(base, Member) and base.name == FIELDS and isinstance(index, Text):
        return Member(base.base, index.value)
    return Op("[]", (base, index))


def of_any_class(target: Expr) -> Expr:
    """Return what is assigned to: an object of which the class is given has any fields, those of another class."""
    if not isinstance(target, Member) or target.name != _CLASS:
        return target
    return Op("[]", (Member(target.base, FIELDS), Opaque(_CLASS)))


def table_of(call: Call) -> Expr:
    """Return a call, or the table of the fields of an object that it gives: `vars(a)`."""
    return Member(call.args[0], FIELDS) if call.callee == Name("vars") and len(call.args) == 1 else call
