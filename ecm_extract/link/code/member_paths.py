"""Members of members: how deep they lie in their object, and how they are called there."""

from __future__ import annotations

from typing import Final, NamedTuple

from ecm_parsers.source.expr import THIS, Expr, Member

MAX_PATH: Final = 4
"""Members of members that are followed: `node = node->next` in a loop asks for ever longer ones."""


def lies_deep(expr: Expr) -> bool:
    """Tell whether a member lies deeper in an object than is followed."""
    depth = 0
    while isinstance(expr, Member):
        depth, expr = depth + 1, expr.base
    return depth > MAX_PATH


class PathBelow(NamedTuple):
    """`a.b` of `params_.a.b`, and the variable that it lies in."""

    path: str
    root: Expr


def below_variable(expr: Expr) -> PathBelow:
    """Return where in a variable, or in a member of the object at hand, something lies."""
    path: list[str] = []
    while isinstance(expr, Member) and expr.base != THIS:
        path.insert(0, expr.name)
        expr = expr.base
    return PathBelow(".".join(path), expr)
