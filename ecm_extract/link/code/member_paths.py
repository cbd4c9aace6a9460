"""Members of members: how deep they lie in their object."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import Expr, Member

MAX_PATH: Final = 4
"""Members of members that are followed: `node = node->next` in a loop asks for ever longer ones."""


def lies_deep(expr: Expr) -> bool:
    """Tell whether a member lies deeper in an object than is followed."""
    depth = 0
    while isinstance(expr, Member):
        depth, expr = depth + 1, expr.base
    return depth > MAX_PATH
