"""Calls of what holds a function: a variable with a lambda, a parameter that somebody gave one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Lambda, Member, Name

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value, demoted, parameter, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_HANDED = 8
"""Functions that hand a function on to one another."""


class ClosureFolder:
    """Finds the functions that variables and parameters hold, and folds what they give."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def value(self, expr: Call, call: Invocation, env: Env) -> tuple[Value, ...] | None:
        """Return what a call of a Python lambda gives; None for calls of anything else."""
        python = env.func.file.language == "python"
        given = self.handed(call, env) if python else None
        if given is not None and isinstance(given.expr, Lambda):
            return self._of_body(given.expr, call, env, given.env)
        ways = self.folder.flow.ways(expr.callee, env) if python and isinstance(expr.callee, Name | Member) else []
        helds = {held for way in ways for held in way}
        made = [held for held in helds if isinstance(held.expr, Lambda) and held.how == "value"]
        if not made:
            is_called = python and call.receiver is None and call.simple
            name = self._open(call, env) if is_called else ""
            return (parameter(name),) if name else None
        body, place = made[0].expr, made[0].env
        own = place is not None and place.func is env.func
        if len(helds) > 1 or not own or not isinstance(body, Lambda):
            return (unknown(call.last),)
        return self._of_body(body, call, env, env) or (unknown(call.last),)

    def _open(self, call: Invocation, env: Env) -> str:
        """The parameter of the outermost function that is called, which its callers know; else nothing."""
        name, place = call.path, env
        for _ in range(MAX_HANDED):
            if name not in place.func.given or name in self.folder.flow.outline(place.func).changes:
                return ""
            bound = place.args.get(name)
            if bound is None:
                return name
            if not isinstance(bound.expr, Name):
                return ""
            name, place = bound.expr.id, bound.env
        return ""

    def _of_body(self, body: Lambda, call: Invocation, env: Env, place: Env) -> tuple[Value, ...] | None:
        """What the body gives at a place for the arguments of a call."""
        plain = body.body is not None and not any("=" in each or "*" in each for each in body.params)
        if not plain or len(body.params) != len(call.args):
            return None
        given = {name: Bound(arg, env) for name, arg in zip(body.params, call.args, strict=True)}
        inner = self.folder.flow.naming(place.deeper(max(place.depth, env.depth) + 1), given)
        return demoted(self.folder.fold(body.body, inner))

    def function(self, call: Invocation, env: Env) -> tuple[Func, Env] | None:
        """Return the function that a parameter holds which is called, with the place that declares it."""
        given = self.handed(call, env) or self._held(call, env)
        name = _name_of(given.expr) if given is not None else ""
        inner = self.folder.nesting.inner(given.env.func) if given is not None and name else ()
        found = [func for func in inner if func.fact.name == name] or (self._of_module(name, given) if given else [])
        return (found[0], given.env) if given is not None and len(found) == 1 else None

    def _of_module(self, name: str, given: Bound) -> Sequence[Func]:
        """The functions of a module of Python that a name means where it is handed on."""
        func = given.env.func
        own = name in self.folder.flow.effects(func).own or func.file.language != "python"
        found = self.folder.program.functions_named(name, func.file, func.scope) if name and not own else ()
        return [each for each in found if each.cls is None]

    def _held(self, call: Invocation, env: Env) -> Bound | None:
        """The name that a variable of the function holds which is called."""
        if call.receiver is not None or not call.simple or call.path not in self.folder.flow.effects(env.func).own:
            return None
        helds = {held for way in self.folder.flow.ways(Name(call.path), env) for held in way}
        only = next(iter(helds)) if len(helds) == 1 else None
        named = only is not None and only.how == "value" and isinstance(only.expr, Name) and only.env is not None
        return Bound(only.expr, only.env) if only is not None and named and only.expr and only.env else None

    def handed(self, call: Invocation, env: Env) -> Bound | None:
        """Return what the caller gave for a parameter that is called, through all who hand it on."""
        if call.receiver is not None or not call.simple or not env.args:
            return None
        given = env.args.get(call.path)
        for _ in range(MAX_HANDED):
            on = given.env.args.get(given.expr.id) if given is not None and isinstance(given.expr, Name) else None
            if on is None:
                break
            given = on
        rebound = call.path in self.folder.flow.outline(env.func).changes
        return None if rebound else given


def _name_of(expr: Expr) -> str:
    return expr.name if isinstance(expr, Lambda) else expr.id if isinstance(expr, Name) else ""
