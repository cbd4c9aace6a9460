"""Variables of the function around the one at hand: what they mean hides what the module calls so."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Name

from ecm_extract.link.running.env import Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def is_around(expr: Expr, env: Env, folder: Folder) -> bool:
    """Tell whether a name is a parameter of the function at hand, or a variable of one around it."""
    if not isinstance(expr, Name):
        return False
    return expr.id in env.func.given or folder.names.captured_at(expr.id, env) is not None


def captured(expr: Expr, env: Env, folder: Folder) -> Bound | None:
    """Return where such a variable holds what it does: where the function is called, else if that stays the same."""
    place = folder.names.captured_at(expr.id, env) if isinstance(expr, Name) else None
    if place is None or not isinstance(expr, Name):
        return None
    given = 0 if expr.id in place.func.given else 1
    stays = folder.flow.outline(place.func).changes.get(expr.id, 0) <= given
    return Bound(expr, place.deeper(env.depth + 1)) if place is env.outer or stays else None
