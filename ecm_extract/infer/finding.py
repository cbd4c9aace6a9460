"""Calls of C++ that look for the name of a parameter, and give it to a variable: `nh.searchParam("rate", key)`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call

from ecm_extract.infer.effect import Effect
from ecm_extract.link.code.walk import dotted

if TYPE_CHECKING:
    from ecm_extract.infer.effects import Effects


def found(call: Call, at: int, effects: Effects) -> tuple[Effect, ...]:
    """Return what becomes of the variable that such a call writes to; nothing of other calls."""
    key = effects.key(call.args[1]) if len(call.args) == 2 and not effects.python else ""
    if not key or not effects.targets.finds(dotted(call.callee) or ""):
        return ()
    return (Effect("found", key, call),) if effects.targets.target(call, effects.func, at) is None else ()
