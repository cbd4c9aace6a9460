"""Objects of Python by other names: each is one object, whatever it is asked by and whenever it was put there."""

from __future__ import annotations

from collections.abc import Callable

from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.flow import Flow


def place_now(whole: Bound, env: Env, flow: Flow) -> Env | None:
    """Return where to ask for a field of an object that something is a name of, or was made of.

    None where a variable of the function at hand has meanwhile become another object.
    """
    if env.func.file.language != "python" or whole.env.func is not env.func:
        return whole.env
    return env if flow.ways(whole.expr, env) == flow.ways(whole.expr, whole.env) else None


def as_variable(whole: Bound, env: Env, made: Callable[[Expr, Env], Bound | None]) -> Bound | None:
    """Return the variable of the function at hand that an object of Python is, which others were made with.

    Args:
        whole: the object, as who was made with it has it.
        env: the place that asks.
        made: tells what a variable is made from.
    """
    if env.func.file.language != "python":
        return None
    for _ in range(MAX_DEPTH):
        if whole.env.func is env.func or not isinstance(whole.expr, Name | Member):
            break
        further = made(whole.expr, whole.env)
        if further is None:
            return None
        whole = further
    return whole if whole.env.func is env.func and isinstance(whole.expr, Name | Member) else None
