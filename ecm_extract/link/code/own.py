"""What a method says of the object at hand: `this->x` of C++ and `self.x` of Python, which are one fact."""

from __future__ import annotations

from typing import TypeGuard

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name


def is_own_member(expr: Expr | None) -> TypeGuard[Member]:
    """Tell whether an expression is a member that is asked of the object at hand."""
    return isinstance(expr, Member) and expr.base == THIS


def own_name(expr: Expr | None) -> str:
    """Return the name of a variable, or of a member of the object at hand; empty for others."""
    if isinstance(expr, Name):
        return expr.id
    return expr.name if is_own_member(expr) else ""


def is_super(receiver: Expr | None) -> bool:
    """Tell whether an expression is the object at hand as its bases see it: `super()`, or `super(Class, self)`."""
    return isinstance(receiver, Call) and receiver.callee == Name("super")
