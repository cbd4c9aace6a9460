"""How expressions are written, as people are shown them."""

from __future__ import annotations

import ast

MAX_SHOWN = 60


def source_of(node: ast.AST) -> str:
    """Return what an expression looks like, cut short; kept with the node, since loops ask for it again and again."""
    if isinstance(node, ast.Name):
        return node.id
    known: str | None = getattr(node, "ecm_source", None)
    if known is None:
        known = _unparsed(node)
        node.ecm_source = known  # type: ignore[attr-defined]
    return known


def _unparsed(node: ast.AST) -> str:
    try:
        return ast.unparse(node)[:MAX_SHOWN]  # type: ignore[no-untyped-call,unused-ignore]
    except (RecursionError, ValueError):
        return type(node).__name__
