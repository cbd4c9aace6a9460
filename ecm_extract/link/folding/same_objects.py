"""Objects of Python by other names: each is one object, whatever it is asked by and whenever it was put there."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.infer.held import all_ways
from ecm_extract.infer.places import whole_of
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.flow import Flow
from ecm_extract.link.running.values import Value, unknown

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_OWN: Final = frozenset({"value", "changed", "stored"})
"""Ways to hold an object, or a list, that nobody has changed but by statements that are followed."""


def place_now(whole: Bound, env: Env, flow: Flow) -> Env | None:
    """Return where to ask for a field of an object that something is a name of, or was made of.

    None where a variable of the function at hand has meanwhile become another object.
    """
    if env.func.file.language != "python" or whole.env.func is not env.func:
        return whole.env
    return env if flow.ways(whole.expr, env) == flow.ways(whole.expr, whole.env) else None


def by_variable(whole: Bound, expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return a field of an object that is a variable of the function at hand, which others were made with.

    Args:
        whole: the object, as who was made with it has it.
        expr: the field.
        env: the place that asks.
        folder: who evaluates.
    """
    for _ in range(MAX_DEPTH):
        if whole.env.func is env.func or not isinstance(whole.expr, Name | Member):
            break
        further = folder.structures.made(whole.expr, whole.env)
        if further is None:
            return ()
        whole = further
    if env.func.file.language != "python" or whole.env.func is not env.func or not isinstance(whole.expr, Name | Member):
        return ()
    place = place_now(whole, env, folder.flow)
    return folder.fold(Member(whole.expr, expr.name), place) if place is not None else (unknown(expr.name),)


def is_as_made(expr: Expr, env: Env, folder: Folder) -> bool:
    """Tell whether nobody has changed an object of Python since it was made: the function at hand made it, or its list."""
    if env.func.file.language != "python":
        return False
    root: Expr | None = expr
    while root is not None and not folder.flow.effects(env.func).key(root):
        root = whole_of(root)
    ways = folder.flow.ways(root, env) if root is not None else []
    made = folder.structures.made(expr, env) if isinstance(expr, Name | Member) else folder.lists.element(expr, env)
    own = bool(ways) and all(held.how in _OWN for way in ways for held in all_ways(way))
    return own and made is not None and isinstance(made.expr, Call)


def left_by_maker(name: str, place: Env, folder: Folder) -> tuple[Value, ...]:
    """Return what a constructor leaves a member with; empty where it does not give it anything itself."""
    run = folder.flow.run(place)
    if run is None or run.end is None or run.end.called:
        return ()
    ways = folder.flow.left(run, f".{name}")
    return folder.held.of([ways], place.deeper(place.depth + 1)) if ways else ()
