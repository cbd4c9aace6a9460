"""Names that an object puts a prefix before.

One of its methods sets it, `loader.setPrefix("camera/")`, or it is a member: a layer of a costmap has its name there.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Opaque, Text
from ecm_parsers.source.facts import Statement
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Func
from ecm_extract.link.declaring.forms import Form
from ecm_extract.link.declaring.match import name_argument

_OPEN: Final = Opaque("prefix")
"""Stands for a prefix that is not known."""


def prefixed(call: Invocation, form: Form) -> Invocation:
    """Return a call of a form with the prefix of its object put before the name; any other call as it is."""
    name = name_argument(form, call) if form.prefix or form.below else None
    prefix = _before(call, form) if name is not None else None
    if name is None or prefix is None:
        return call
    args = [Op("+", (prefix, arg)) if arg is name else arg for arg in call.args]
    return replace(call, args=tuple(args))


def _before(call: Invocation, form: Form) -> Expr | None:
    """What stands before the names of a call: a member of its object, or what that was told."""
    if form.below:
        return Op("+", (Member(call.receiver or THIS, form.below), Text(".")))
    return _prefix(call, form.prefix) if call.receiver is not None else None


def _prefix(call: Invocation, setter: str) -> Expr | None:
    """The prefix that an object has at a call: as the last statement before it set it; None when none did."""
    before = [each for each in call.func.fact.body[: call.at] if _sets(each, setter, call.receiver)]
    if not before:
        return _OPEN if _is_set_elsewhere(call, setter) else None
    last = before[-1].value
    sure = before[-1].depth == 0 and isinstance(last, Call) and len(last.args) == 1
    return last.args[0] if sure and isinstance(last, Call) else _OPEN


def _sets(statement: Statement, setter: str, receiver: Expr | None) -> bool:
    value = statement.value
    return (
        isinstance(value, Call)
        and isinstance(value.callee, Member)
        and value.callee.name == setter
        and value.callee.base == receiver
    )


def _is_set_elsewhere(call: Invocation, setter: str) -> bool:
    """Tell whether who shares an object may have set its prefix: another method, or whoever gives it."""
    receiver = call.receiver
    if isinstance(receiver, Name) and any(entry.name == receiver.id for entry in call.func.fact.params):
        return True
    others: Sequence[Func] = call.func.cls.methods if call.func.cls is not None else ()
    return any(_sets(each, setter, receiver) for func in others for each in func.fact.body if func is not call.func)
