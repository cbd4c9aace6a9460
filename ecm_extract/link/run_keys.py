"""What tells one run of a function from another."""

from __future__ import annotations

from collections.abc import Hashable, Mapping

from ecm_parsers.source.expr import Constant, Number, Text

from ecm_extract.link.env import Bound, Env, Instance

MAX_KEY = 4
"""Callers of callers that tell one run from another; beyond, each is a run of its own."""


def run_key(env: Env, depth: int = 0) -> Hashable:
    """Return what a run depends on: the function, what its parameters are, its object, who is around it."""
    if env.asked is not None:
        return env.asked
    this = env.this or env.func.cls
    around = (run_key(env.outer, depth + 1), env.outer.at, env.outer.state) if env.outer is not None else None
    caller = _bound_key(env.caller, depth) if env.caller is not None else None
    asked = env.func, _bound_keys(env.args, depth), this, _made_key(env.made, depth), around, caller
    if not depth:
        env.asked = asked
    return asked


def _bound_keys(args: Mapping[str, Bound], depth: int) -> tuple[Hashable, ...]:
    return tuple([(name, _bound_key(bound, depth)) for name, bound in args.items()])


def _bound_key(bound: Bound, depth: int) -> Hashable:
    """An argument by what it is and where it stands: one that is written out means the same everywhere."""
    env, expr = bound.env, bound.expr
    if isinstance(expr, Text | Number | Constant):
        return expr
    if env.state is not None:  # a state belongs to one run, and so to what that run depends on
        return expr, env.func, env.at, env.state, env.this, _made_key(env.made, depth)
    return (expr, env.at, run_key(env, depth + 1)) if depth < MAX_KEY else bound


def _made_key(made: Instance | None, depth: int) -> Hashable:
    if made is None or not (made.args or made.types or made.maker):
        return None
    if depth >= MAX_KEY:
        return made
    return made.cls, made.maker, _bound_keys(made.args, depth + 1), tuple(made.types.items())
