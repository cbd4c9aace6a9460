"""Objects of Python that a choice gives: fields of `(SIMULATED if flag else REAL)`, in a variable or as it stands."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Member, Name, Op

from ecm_extract.link.folding.same_objects import place_now
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.values import Value, alternatives, demoted

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def field_of_chosen(expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return a field of an object that is one of several; empty of others, and where one may have become another."""
    if env.depth >= MAX_DEPTH or env.func.file.language != "python":
        return ()
    made = Bound(expr.base, env) if isinstance(expr.base, Op) else folder.structures.made(expr.base, env)
    sides = sides_of(made, folder) if made is not None else []
    fields = [_field(side, expr, env, folder) for side in sides if side is not made]
    return alternatives([value for values in fields for value in values]) if all(fields) and fields else ()


def sides_of(made: Bound, folder: Folder) -> list[Bound]:
    """Return what a choice may give, both sides where nobody can decide it; anything else itself."""
    if not isinstance(made.expr, Op) or made.expr.op != "?:":
        return [made]
    test, first, second = made.expr.operands
    holds = folder.flow.truth(test, made.env)
    taken = [first, second] if holds is None else [first if holds else second]
    return [each for side in taken for each in sides_of(Bound(side, made.env), folder)]


def _field(side: Bound, expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """The field of one side; nothing where its variable, or the object, is not what it was when it was chosen."""
    if not isinstance(side.expr, Name | Member) or folder.structures.is_touched(side.expr, side.env):
        return ()
    place = place_now(side, env, folder.flow)
    if place is None:
        return ()
    return demoted(folder.fold(Member(side.expr, expr.name), place.deeper(max(env.depth, place.depth) + 1)))
