"""What tells one run of a function from another."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Final

from ecm_parsers.source.expr import Constant, Number, Text

from ecm_extract.link.running.env import Bound, Env, Instance

MAX_KEY: Final = 40
"""Callers of callers that tell one run from another; beyond, each is a run of its own."""


class RunKey:
    """Stands for everything that a run depends on: equal places have the same one, which is cheap to compare."""

    __slots__ = ()


class RunKeys:
    """Gives places their keys; each is worked out once, whatever other keys it is a part of."""

    def __init__(self) -> None:
        self._keys: dict[Hashable, RunKey] = {}

    def forget(self) -> None:
        """Drop what keys stand for; those that were given stay different from all others."""
        self._keys.clear()

    def of(self, env: Env, depth: int = 0) -> RunKey:
        """Return what a run depends on: the function, what its parameters are, its object, who is around it."""
        if env.asked is None:
            this = env.this or env.func.cls
            around = (self.of(env.outer, depth + 1), env.outer.at, env.outer.state) if env.outer is not None else None
            caller = self._bound(env.caller, depth, {}) if env.caller is not None else None
            call = self._bound(env.call, depth, {}) if env.call is not None else None
            args = self._all_bound(env.args, depth)
            env.asked = self._key((env.func, args, this, self._made(env.made, depth), around, caller, call))
        return env.asked

    def _key(self, parts: Hashable) -> RunKey:
        known = self._keys.get(parts)
        if known is None:
            known = self._keys[parts] = RunKey()
        return known

    def _all_bound(self, args: Mapping[str, Bound], depth: int) -> tuple[Hashable, ...]:
        places: dict[Env, Hashable] = {}  # the arguments of a call stand in one place, or in few
        return tuple([(name, self._bound(bound, depth, places)) for name, bound in args.items()])

    def _bound(self, bound: Bound, depth: int, places: dict[Env, Hashable]) -> Hashable:
        """An argument by what it is and where it stands: one that is written out means the same everywhere."""
        if isinstance(bound.expr, Text | Number | Constant):
            return bound.expr
        if bound.env.state is None and depth >= MAX_KEY:
            return bound
        if bound.env not in places:
            places[bound.env] = self._place(bound.env, depth)
        return bound.expr, places[bound.env]

    def _place(self, env: Env, depth: int) -> Hashable:
        if env.state is not None:  # a state belongs to one run, and so to what that run depends on
            return env.func, env.at, env.state, env.this, self._made(env.made, depth)
        return env.at, self.of(env, depth + 1)

    def _made(self, made: Instance | None, depth: int) -> Hashable:
        if made is None or not made.is_one:
            return None
        if depth >= MAX_KEY:
            return made
        given = self._all_bound(made.args, depth + 1)
        return self._key((made.cls, made.maker, given, tuple(made.types.items()), made.exact))
