"""Sequences as they are written: spread and concatenated ones in place."""

from __future__ import annotations

from ecm_parsers.source.expr import Expr, Items, Name, Op

from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env


def flat(expr: Expr, env: Env) -> list[Bound]:
    """Return the elements of a sequence; what is no display, and is not given as one, is an element itself."""
    if env.depth > MAX_DEPTH:
        return [Bound(expr, env)]
    if isinstance(expr, Items):
        return [bound for item in expr.items for bound in flat(item, env.before(env.at))]
    if isinstance(expr, Op) and expr.op in {"+", "*"}:
        return [bound for operand in expr.operands for bound in flat(operand, env.before(env.at))]
    if isinstance(expr, Name) and expr.id in env.args:
        given = env.args[expr.id]
        return flat(given.expr, given.env.before(given.env.at))
    return [Bound(expr, env)]
