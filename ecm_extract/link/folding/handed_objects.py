"""Objects of C++ that a function is given: what their methods tell of members that only methods can change.

`void keep(std::shared_ptr<Part> part) { declare_parameter(part->name()); }` asks whatever its callers made.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name, Op

from ecm_extract.link.code.spelling import by_value
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import Env, Instance
from ecm_extract.link.running.values import Hole, Value

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_KEPT: Final = frozenset({"const", "private", "protected"})
"""Traits of members that nobody changes who only has the object: its methods do, or nobody."""


class HandedObjects:
    """Tells how such an object was made, and whose the answer is as long as nobody has handed one."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def instance(self, receiver: Expr, callee: Func, env: Env) -> Instance | None:
        """Return how an object is made that the function at hand was given, as its maker says; None of others."""
        expr, place = receiver, env
        while isinstance(expr, Name):
            bound = place.args.get(expr.id)
            if bound is None:
                break
            if expr.id in self.folder.flow.outline(place.func).changes:
                return None  # it may be another one by now
            expr, place = _behind(bound.expr), bound.env
        if place is env or not (self._asks_kept(callee) and self._is_as_made(expr, place)):
            return None
        made = self.folder.makers.of(expr, place)
        return made if made is not None and not self._has_its_own(made.cls, callee) else None

    def _has_its_own(self, cls: Cls, callee: Func) -> bool:
        """Whether a class has another method by the name of one of its base, which may run in its place."""
        lineage = self.folder.program.ancestry(cls)
        named = (each for own in lineage for each in own.methods if each.fact.name == callee.fact.name)
        return any(each is not callee and not _declares(each, callee) for each in named)

    def _is_as_made(self, expr: Expr, place: Env) -> bool:
        """Whether a variable still has what it was given last: nobody was handed it who may have changed that."""
        ways = self.folder.flow.ways(expr, place)
        return bool(ways) and all(held.how == "value" for way in ways for held in way)

    def known_by_callers(self, value: Value, receiver: Expr, env: Env) -> Value:
        """What the maker of an object knows that the function at hand is given, its callers know."""
        label = receiver.id if isinstance(receiver, Name) else ""
        if label not in env.func.given or label in env.args:
            return value
        parts = [
            Hole(label, "param", part=part.label) if isinstance(part, Hole) and part.kind == "made" else part
            for part in value.parts
        ]
        return value._replace(parts=tuple(parts))

    def _asks_kept(self, callee: Func) -> bool:
        """Whether a method reads nothing but members that only methods change."""
        named = self.folder.shifting.names(callee) - callee.given
        lineage = self.folder.program.ancestry(callee.cls) if callee.cls is not None else ()
        return bool(named) and all(any(_is_kept(name, cls) for cls in lineage) for name in named)


def _behind(expr: Expr) -> Expr:
    """The object that a pointer is taken from: `box` of `box.get()`, `&box` and `*box`."""
    if isinstance(expr, Op) and expr.op in {"&", "*"} and len(expr.operands) == 1:
        return _behind(expr.operands[0])
    gets = isinstance(expr, Call) and isinstance(expr.callee, Member) and expr.callee.name == "get" and not expr.args
    return expr.callee.base if gets and isinstance(expr, Call) and isinstance(expr.callee, Member) else expr


def _is_kept(name: str, cls: Cls) -> bool:
    field = cls.fields.get(name)
    return field is not None and by_value(field.type) and bool(_KEPT & set(field.traits))


def _declares(method: Func, other: Func) -> bool:
    """Whether a method is no more than what the class says of another one, whose body stands outside of it."""
    return method.cls is other.cls and "declaration" in method.fact.traits
