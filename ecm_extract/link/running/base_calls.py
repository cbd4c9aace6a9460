"""Calls by which constructors make the bases of their objects."""

from __future__ import annotations

from typing import TypeGuard

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name

from ecm_extract.link.code.calls import Invocation, dotted_name, one_node
from ecm_extract.link.code.own import is_super
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func


def base_call(func: Func, parent: Cls) -> Invocation | None:
    """Return the call by which a constructor makes its base, or leaves its work to another one; None without one."""
    for at, statement in enumerate(func.fact.body):
        value, target = statement.value, statement.target
        if statement.kind == "init" and isinstance(target, Name) and last_name(target.id) == parent.fact.name:
            args = value.args if isinstance(value, Call) and value.callee == target else (value,) if value else ()
            return Invocation(func, at, statement, target.id, None, one_node(func, args), (), (), statement.line)
        if isinstance(value, Call) and _calls_super(value, parent):
            args = value.args[1:] if value.args[:1] == (THIS,) else value.args
            return Invocation(func, at, statement, "super", None, args, value.keywords, (), statement.line)
    return None


def makes_base(value: Expr | None) -> TypeGuard[Call]:
    """Tell whether an expression of Python is `super().__init__(depth=1)`, or `Base.__init__(self, depth=1)`."""
    return isinstance(value, Call) and isinstance(value.callee, Member) and value.callee.name == "__init__"


def _calls_super(call: Call, parent: Cls) -> bool:
    if not makes_base(call) or not isinstance(call.callee, Member):
        return False
    return is_super(call.callee.base) or last_name(dotted_name(call.callee.base)) == parent.fact.name
