"""How the object is made that a variable stands for, whoever has it meanwhile: nobody makes it another one by that."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.infer.held import Held, all_ways
from ecm_extract.link.code.units import Cls
from ecm_extract.link.running.env import MAX_DEPTH, Env, Instance

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_NO_BODY: Final = frozenset({"declaration", "deleted"})
_CHANGED: Final = frozenset({"handed", "reached", "out", "lost"})
"""Ways to hold an object of Python of which somebody may have changed what it consists of."""
MAX_HANDED = 12
"""Functions that hand an object on, each to the next."""


class ObjectMakers:
    """Follows objects through arguments to the one call that makes them."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def of(self, expr: Expr | None, env: Env) -> Instance | None:
        """Return how the object is made; None where that is not known, or where several calls may have made it."""
        for _ in range(MAX_HANDED):
            bound = env.args.get(expr.id) if isinstance(expr, Name) else None
            if bound is None:
                break
            expr, env = bound.expr, bound.env
        if not isinstance(expr, Name | Member) or env.func.file.language != "cpp" or env.depth > MAX_DEPTH:
            return None
        makers = self.folder.origins.makers(expr, env) or ()
        maker = makers[0] if len(makers) == 1 else None
        if maker is None or not isinstance(maker.expr, Call):
            return None
        begun = self.folder.states.constructor(maker.expr, maker.env)
        if begun is None or begun.made is None or not _are_told_apart(begun.func.cls):
            return None
        return self.folder.objects.delegated(begun.made)

    def of_python(self, expr: Expr, env: Env) -> Env | None:
        """Return the beginning of the constructor that makes an object of Python, through variables and callers."""
        for _ in range(MAX_HANDED):
            if isinstance(expr, Name | Member) and self._is_had_by_others(expr, env):
                return None
            helds = self.folder.origins.of(expr, env) if isinstance(expr, Name | Member) else []
            held = helds[0] if len(helds) == 1 else None
            if held is None or held.how != "value" or held.expr is None:
                break
            expr, env = held.expr, held.env or env
        return self.folder.states.constructor(expr, env) if isinstance(expr, Call) else None

    def _is_had_by_others(self, expr: Expr, env: Env) -> bool:
        """Whether somebody may have changed what an object of Python consists of, by whatever he has it from."""
        ways = self.folder.flow.ways(expr, env)
        return any(held.how in _CHANGED for way in ways for held in all_ways(way))

    def left_in(self, expr: Member, env: Env) -> tuple[Held, Env] | None:
        """Return what its constructor leaves a member of the one object of Python with, which nobody changes later."""
        maker = self.of_python(expr.base, env) if env.func.file.language == "python" else None
        cls, folder = maker.this if maker is not None else None, self.folder
        if maker is None or cls is None or folder.object_fields.is_given(expr.name, cls):
            return None
        found = folder.members.sources(expr.name, cls, maker)
        return found[0] if len(found) == 1 and not folder.changed_outside.is_changed(expr.name, cls) else None

    def part(self, receiver: Expr | None, cls: Cls, env: Env) -> Instance:
        """Return the part of a class of an object, with what that was made with; of others what their type tells."""
        held = self.folder.objects.held(receiver, cls, env)
        made = self.of(receiver, env)
        part = self.folder.objects.part(made, cls) if made is not None else None
        return replace(part, types={**part.types, **held.types}) if part is not None else held


def _are_told_apart(cls: Cls | None) -> bool:
    """Whether the number of its arguments tells which constructor of a class a call means."""
    methods = cls.methods if cls is not None else ()
    makers = [each for each in methods if each.is_constructor and not _NO_BODY & set(each.fact.traits)]
    spans = sorted(each.arity for each in makers)
    return all(one[1] < other[0] for one, other in pairwise(spans))
