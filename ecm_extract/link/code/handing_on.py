"""Whether a call gives others the object at hand, or a function that may use it."""

from __future__ import annotations

from collections.abc import Callable

from ecm_parsers.source.expr import Call, Expr, Lambda, Member, Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.walk import calls_in, children

THIS = Name("this")


def hands_on(call: Call | Invocation, is_method: Callable[[str], bool]) -> bool:
    """Tell whether the arguments of a call are, or hold, the object at hand, a method of it, or a lambda that uses it.

    Args:
        call: the call.
        is_method: tells whether the object has a method of a name.
    """
    return any(_gives(arg, is_method) for arg in (*call.args, *(value for _, value in call.keywords)))


def _reaches(call: Call, is_method: Callable[[str], bool]) -> bool:
    """Whether a call in a lambda runs a method of the object at hand, changes a part of it, or hands it on."""
    callee = call.callee
    if isinstance(callee, Member) and callee.base == THIS:
        return is_method(callee.name) or hands_on(call, is_method)
    root = callee
    while isinstance(root, Member):
        root = root.base
    return root == THIS or hands_on(call, is_method)


def _gives(expr: Expr, is_method: Callable[[str], bool]) -> bool:
    if isinstance(expr, Lambda):
        return expr.body is None or any(_reaches(call, is_method) for call in calls_in(expr.body))
    if expr == THIS:
        return True
    if isinstance(expr, Member) and expr.base == THIS:
        return is_method(expr.name)
    if isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.base == THIS:
        return hands_on(expr, is_method)
    return any(_gives(part, is_method) for part in children(expr))
