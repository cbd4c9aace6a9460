"""Functions within functions as values: `auto get = handler.getter(prefix); get(x, "name", 1);`.

A function that another one returns, or keeps in a member, is called where nobody writes its name. It sees the variables
of the function around it as they were when it was made.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Lambda, Member, Name

from ecm_extract.link.code.calls import Invocation, Step, invocation, invocations
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import given_to
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Making(NamedTuple):
    """The call that gave a variable its function: in which statement of which function it stands."""

    func: Func
    at: int
    call: Invocation


def around(func: Func, folder: Folder) -> Func | None:
    """Return the function that one is declared in; None of methods and of what stands alone."""
    return folder.nesting.enclosing(func) if func.cls is None and func.fact.scope else None


def is_returned(func: Func, outer: Func) -> bool:
    """Tell whether a function is one that the function around it returns."""
    return any(entry.kind == "return" and _named(entry.value) == func.fact.name for entry in outer.fact.body)


def uses(func: Func, outer: Func, makers: Iterable[Invocation]) -> Iterator[Invocation]:
    """Yield the calls of what holds a function: of members, and of what the calls of the function around it give.

    Args:
        func: the function.
        outer: the function that it is declared in.
        makers: the calls of that; nobody asks for them where it does not return the function.
    """
    for statement in outer.fact.body:
        if (
            statement.kind == "set"
            and isinstance(statement.target, Member)
            and _named(statement.value) == func.fact.name
        ):
            yield from _of_holder(statement.target, outer)
    for maker in makers if is_returned(func, outer) else ():
        yield from _straight(maker)
        if maker.statement.kind in {"let", "set"} and _is_whole(maker):
            yield from _of_holder(maker.statement.target, maker.func)


def handed_to(func: Func, outer: Func) -> Iterator[tuple[Invocation, Expr]]:
    """Yield the calls in the function around that hand a function to somebody, with the argument that it is."""
    for at, calls in enumerate(outer.calls):
        for call in calls:
            given = (arg for arg in given_to(call) if _is(arg, func))
            yield from ((invocation(Step(outer, at, outer.fact.body[at]), call), arg) for arg in given)


def uses_handed(call: Invocation, arg: Expr, callee: Func) -> Iterator[Invocation]:
    """Yield the calls of a parameter in a function that is given an argument for it."""
    bound = bind(callee, call, Env(call.func, call.at))
    names = {name for name, each in bound.items() if each.expr is arg}
    yield from (use for use in invocations(callee, names) if use.simple and use.path in names)


def given(func: Func, use: Invocation, env: Env) -> Env | None:
    """Return the place at which a function was handed to who calls it at a place; None where another one was."""
    bound = env.args.get(use.path) if is_of_parameter(use) else None
    return bound.env if bound is not None and _is(bound.expr, func) else None


def is_of_parameter(use: Invocation) -> bool:
    """Tell whether a call is one of what its function is given."""
    return use.simple and any(parameter.name == use.path for parameter in use.func.fact.params)


def _is(expr: Expr, func: Func) -> bool:
    return isinstance(expr, Lambda | Name) and _named(expr) == func.fact.name


def captured(func: Func, use: Invocation, env: Env, folder: Folder) -> Env:
    """Return the place at which a function within another was made, of which it sees the variables.

    Args:
        func: the function.
        use: its call.
        env: where that stands, which is the place itself for a function that is called where it is declared.
        folder: resolves the function that returned it.
    """
    outer = around(func, folder)
    if outer is None:
        return env
    handed = given(func, use, env)
    if handed is not None:
        return folder.lent.place(func, handed, env)
    made = _making(use) if is_returned(func, outer) else None
    if made is None:
        return _nearest(outer, env)
    same = made.func is env.func
    place = env.before(made.at) if same else Env(made.func, made.at, this=env.this, made=env.made, depth=env.depth + 1)
    this = env.this if made.call.receiver in {None, THIS} else outer.cls
    instance = env.made
    if this is not env.this:
        instance = folder.objects.held(made.call.receiver, this, place) if this is not None else None
    return Env(outer, args=bind(outer, made.call, place), this=this, made=instance, depth=env.depth + 1)


def _nearest(outer: Func, env: Env) -> Env:
    """The place in the function around that led to a call; any of the same object where none did."""
    place: Env | None = env
    while place is not None and place.func is not outer:
        place = place.outer
    if place is not None:
        return place
    return env if outer.cls is None else Env(outer, this=env.this, made=env.made, depth=env.depth + 1)


def _named(expr: Expr | None) -> str:
    """The name of the function that an expression is."""
    return expr.name if isinstance(expr, Lambda) else expr.id if isinstance(expr, Name) else ""


def _straight(maker: Invocation) -> Iterator[Invocation]:
    """`getter(prefix)("name", 1)`: what a call gives is called at once."""
    for call in maker.func.calls[maker.at] if maker.at < len(maker.func.calls) else ():
        callee = call.callee
        if isinstance(callee, Call) and callee.line == maker.line and callee.args == maker.args:
            yield invocation(Step(maker.func, maker.at, maker.statement), call)


def _of_holder(target: Expr | None, func: Func) -> Iterator[Invocation]:
    """The calls of a variable in its function, of a member in all methods of its class."""
    if isinstance(target, Name):
        yield from (call for call in invocations(func, {target.id}) if call.path == target.id)
    elif is_own_member(target):
        methods: Sequence[Func] = func.cls.methods if func.cls is not None else ()
        for method in methods:
            yield from (call for call in invocations(method, {target.name}) if call.receiver == THIS)


def _making(use: Invocation) -> Making | None:
    """The call that gave what is called its function; None where none does, or one of several."""
    straight = next((call for call in use.func.calls[use.at] if _is_of(call, use)), None) if not use.path else None
    if straight is not None and isinstance(straight.callee, Call):
        return Making(use.func, use.at, invocation_of(straight.callee, Env(use.func, use.at)))
    target: Expr = Name(use.path) if use.receiver is None else Member(THIS, use.last)
    funcs = (use.func,) if use.receiver is None or use.func.cls is None else use.func.cls.methods
    found = [made for func in funcs for made in _given(func, target)]
    return found[0] if len(found) == 1 else _last(found, use)


def _is_of(call: Call, use: Invocation) -> bool:
    return isinstance(call.callee, Call) and call.args == use.args and call.line == use.line


def _given(func: Func, target: Expr) -> Iterator[Making]:
    for at, statement in enumerate(func.fact.body):
        if statement.target == target and isinstance(statement.value, Call):
            yield Making(func, at, invocation_of(statement.value, Env(func, at)))


def _last(found: Sequence[Making], use: Invocation) -> Making | None:
    """The last of several before a use, where all of them surely happen one after the other."""
    straight = all(made.func is use.func and made.func.fact.body[made.at].depth == 0 for made in found)
    before = [made for made in found if made.at < use.at]
    return before[-1] if straight and before else None


def _is_whole(maker: Invocation) -> bool:
    """Whether a variable is given what the call returns, and not what is made of it."""
    value = maker.statement.value
    return isinstance(value, Call) and value.line == maker.line and value.args == maker.args
