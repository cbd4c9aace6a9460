"""Fields of structures that hold settings: what the functions at hand write to them.

`nh.param("topic", params_.topic, "scan")` or `params.topic = ...` in one method, `params_.topic` in another. The
variables may have different names: what is assigned is told by the class of the structure, what is read by the field.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.link.env import Env, invocation_of
from ecm_extract.link.program import Func
from ecm_extract.link.values import MAX_ALTERNATIVES, Value, demoted, unique

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder


class FieldFolder:
    """Folds `object.field` by the assignments to that field."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def value(self, expr: Member, env: Env) -> tuple[Value, ...]:
        """Return what the field can hold; empty when nothing at hand writes it."""
        return self.folder.guarded(f"->{expr.name}", env, lambda: self._value(expr, env))

    def _value(self, expr: Member, env: Env) -> tuple[Value, ...]:
        found: list[Value] = []
        for func in self._functions(expr, env):
            found += self._written(expr, func, env)
        filled = [value for value in found if value.text]
        return unique(filled or found)[:MAX_ALTERNATIVES] if found else ()

    def _written(self, expr: Member, func: Func, env: Env) -> Iterator[Value]:
        reads = self.folder.reads.written(func, f".{expr.name}")
        sets = self.folder.scope.fields(func).get(expr.name, ())
        limit = env.at if func is env.func else len(func.fact.body)
        for at, name, default in reads:
            if at < limit:
                yield from self.folder.calls.parameter_value(name, default, self._inside(func, at, env))
        for at in sets:
            inner = self._inside(func, at, env)
            target = func.fact.body[at].target
            if at < limit and isinstance(target, Member) and self._same_kind(expr.base, env, target.base, inner):
                yield from demoted(self.folder.fold(func.fact.body[at].value, inner))

    def _same_kind(self, one: Expr, env: Env, other: Expr, inner: Env) -> bool:
        """Tell whether two objects are of one class, or called the same where a class is not known."""
        first = self.folder.objects.class_of(one, env)
        second = self.folder.objects.class_of(other, inner)
        return one == other if first is None or second is None else first is second

    def _functions(self, expr: Member, env: Env) -> Iterator[Func]:
        """The function at hand, the methods of its class, and what it hands the object to."""
        yield env.func
        cls = env.this or env.func.cls
        for entry in self.folder.program.ancestry(cls) if cls is not None else ():
            yield from (method for method in entry.methods if method is not env.func)
        root = expr.base
        while isinstance(root, Member):
            root = root.base
        for at, call, _ in self.folder.scope.passed(env.func, root.id) if isinstance(root, Name) else ():
            callee = self.folder.objects.callee(invocation_of(call, env.before(at)), env.before(at))
            if at < env.at and callee is not None and callee.cls is not cls:
                yield callee

    def _inside(self, func: Func, at: int, env: Env) -> Env:
        if func is env.func:
            return env.before(at)
        return Env(func, at, this=func.cls and (env.this or func.cls), depth=env.depth + 1)
