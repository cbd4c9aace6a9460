"""Objects of Python by other names: each is one object, whatever it is asked by and whenever it was put there."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Call, Expr, Lambda, Member, Name

from ecm_extract.infer.bare_names import bare_names
from ecm_extract.infer.effects import is_within
from ecm_extract.infer.held import all_ways
from ecm_extract.infer.places import whole_of
from ecm_extract.link.code.spelling import may_be_written
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import given_to
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


def by_variable(whole: Bound | None, expr: Member, env: Env, folder: Folder) -> tuple[Value, ...]:
    """Return a field of an object that is a variable of the function at hand, which others were made with.

    Args:
        whole: the object, as who was made with it has it; None where that is not known.
        expr: the field.
        env: the place that asks.
        folder: who evaluates.
    """
    for _ in range(MAX_DEPTH):
        if whole is None or whole.env.func is env.func or not isinstance(whole.expr, Name | Member):
            break
        whole = folder.structures.made(whole.expr, whole.env)
    if whole is None or env.func.file.language != "python" or whole.env.func is not env.func:
        return ()
    if not isinstance(expr.base, Member) or not isinstance(whole.expr, Name | Member):
        return ()
    place = place_now(whole, env, folder.flow)
    return folder.fold(Member(whole.expr, expr.name), place) if place is not None else (unknown(expr.name),)


def is_as_made(expr: Expr, env: Env, folder: Folder) -> bool:
    """Tell whether nobody has changed an object that the function at hand made, or made a list of.

    In C++ nobody else has it either: who keeps a reference to it changes it when he likes.
    """
    if isinstance(expr, Call) and folder.structures.class_called(expr, env) is not None:
        return True  # which nobody has yet
    root: Expr | None = expr
    while root is not None and not folder.flow.ways(root, env):
        root = whole_of(root)
    ways = folder.flow.ways(root, env) if root is not None else []
    made = folder.structures.made(expr, env) if isinstance(expr, Name | Member) else folder.lists.element(expr, env)
    for _ in range(MAX_DEPTH):  # what is passed to who keeps it is made there
        if made is None or made.env.func is env.func or not isinstance(made.expr, Name | Member):
            break
        made = folder.structures.made(made.expr, made.env)
    own = bool(ways) and all(held.how in _OWN for way in ways for held in all_ways(way))
    if env.func.file.language == "cpp" and root is not None and _is_handed(root, env, folder.flow):
        return False
    return own and made is not None and isinstance(made.expr, Call)


def _is_handed(variable: Expr, env: Env, flow: Flow) -> bool:
    """Whether a call before gets a variable of C++, or a part of it, that it may write to, be it to make an object."""
    effects = flow.effects(env.func)
    key = effects.key(variable) or effects.root(variable)
    placed = ((at, call) for at, group in enumerate(env.func.calls[: env.at]) for call in group)
    given = (effects.root(arg) for at, call in placed for arg in _written_by(call, env.func, at, flow))
    return any(is_within(each, key) or is_within(key, each) for each in given if each)


def _written_by(call: Call, func: Func, at: int, flow: Flow) -> Iterator[Expr]:
    """Yield the arguments of a call but those that a function of the tree gets as constants or copies."""
    target = flow.target(call, func, at)
    params = target.fact.params if target is not None else ()
    for place, arg in enumerate(given_to(call)):
        if place >= len(params) or may_be_written(params[place].type):
            yield arg


def left_by_maker(name: str, place: Env, exact: bool, folder: Folder) -> tuple[Value, ...]:
    """Return what a constructor leaves a member with, and unless `exact` what methods of the class make of it."""
    if place.this is None:
        return ()
    run = folder.flow.run(place) if exact and not _changes_unasked(place.this, folder) else None
    ways = folder.flow.left(run, f".{name}") if run is not None and run.end is not None and not run.end.called else ()
    if ways:
        return folder.held.of([ways], place.deeper(place.depth + 1))
    return folder.members.member_value(name, place.this, place)


def _changes_unasked(cls: Cls, folder: Folder) -> bool:
    """Whether members may change without a call of a method by its name.

    Methods that Python runs do so, for `with`, operators and properties, and those that are handed to others, as
    callbacks are; whoever is handed the object itself may give them anything.
    """
    everything = [each for entry in folder.program.ancestry(cls) for each in entry.methods]
    handed = [arg for method in everything for arg in _handed_on(method)]
    if any(arg == THIS or isinstance(arg, Lambda) for arg in handed):
        return True
    names = {arg.name for arg in handed if isinstance(arg, Member) and arg.base == THIS}
    methods = (each for each in everything if not each.is_constructor)
    unasked = (each for each in methods if each.fact.name.startswith("__") or each.fact.decorators)
    named = (each for each in everything if each.fact.name in names)
    return any(not folder.methods.leaves(each, cls) for each in (*unasked, *named))


def _handed_on(method: Func) -> Iterator[Expr]:
    """Yield what a method gives to what it calls, in whatever it stands."""
    for call in (call for group in method.calls for call in group):
        for arg in given_to(call):
            yield from (arg, *bare_names(arg))


def variable_given(call: Call, env: Env, folder: Folder) -> Bound | None:
    """Return the variable that a function of Python gives back; None where it gives anything else."""
    given = folder.returns.given_back(Bound(call, env))
    return given if given.expr is not call else None
