"""What a variable surely holds, as it was written."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.running.flow import Flow


def surely_held(expr: Expr, env: Env, flow: Flow) -> Bound | None:
    """Return the expression that a variable was given, with where it is evaluated; None for one of several."""
    ways = flow.ways(expr, env) if isinstance(expr, Name | Member) else []
    helds = {held for way in ways for held in way}
    held = next(iter(helds), None)
    if held is None or len(helds) > 1 or held.how != "value" or held.expr is None or held.env is None:
        return None
    return Bound(held.expr, held.env)
