"""Whether a call gives others the object at hand, or a function that may use it."""

from __future__ import annotations

from collections.abc import Callable

from ecm_parsers.source.expr import Call, Expr, Lambda, Member, Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.walk import children

THIS = Name("this")


def hands_on(call: Call | Invocation, is_method: Callable[[str], bool]) -> bool:
    """Tell whether the arguments of a call are, or hold, the object at hand, a method of it, or a lambda.

    Args:
        call: the call.
        is_method: tells whether the object has a method of a name.
    """
    return any(_gives(arg, is_method) for arg in (*call.args, *(value for _, value in call.keywords)))


def _gives(expr: Expr, is_method: Callable[[str], bool]) -> bool:
    if expr == THIS or isinstance(expr, Lambda):
        return True
    if isinstance(expr, Member) and expr.base == THIS:
        return is_method(expr.name)
    if isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.base == THIS:
        return hands_on(expr, is_method)
    return any(_gives(part, is_method) for part in children(expr))
