"""Lambdas that a function returns: `auto get = handler.getter(prefix); get(x, "name", 1);`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.cpp_body import RETURNED
from ecm_parsers.source.expr import Call, Name

from ecm_extract.link.calls import Invocation, invocations
from ecm_extract.link.env import Env, bind, invocation_of
from ecm_extract.link.units import Func

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder

_THIS: Final = Name("this")


class Making(NamedTuple):
    """The call that gave a variable its lambda: in which statement, and which function was called."""

    at: int
    call: Invocation


def is_returned(func: Func) -> bool:
    """Tell whether a function is a lambda that another one returns."""
    return func.fact.name == RETURNED and "lambda" in func.fact.traits


def uses(makers: Sequence[Invocation]) -> Iterator[Invocation]:
    """Yield the calls of variables that hold what some calls return."""
    for maker in makers:
        held = maker.statement.target
        if maker.statement.kind in {"let", "set"} and isinstance(held, Name) and _is_whole(maker):
            yield from (call for call in invocations(maker.func, {held.id}) if call.path == held.id)


def making(use: Invocation) -> Making | None:
    """Return the call that gave the variable that is called what it holds; None for any other call."""
    body = use.func.fact.body
    for at, statement in enumerate(body):
        if statement.target == Name(use.path) and isinstance(statement.value, Call):
            return Making(at, invocation_of(statement.value, Env(use.func, at)))
    return None


def captured(func: Func, use: Invocation, env: Env, folder: Folder) -> Env:
    """Return the place at which a returned lambda was made, which it sees the variables of; that of who calls it else.

    Args:
        func: the lambda.
        use: its call.
        env: where that stands.
        folder: resolves the function that returned it.
    """
    outer = folder.flow.enclosing(func)
    made = making(use) if is_returned(func) else None
    if outer is None or made is None:
        return env
    place = env.before(made.at)
    this = env.this if made.call.receiver in {None, _THIS} else outer.cls
    instance = env.made
    if this is not env.this:
        instance = folder.objects.held(made.call.receiver, this, place) if this is not None else None
    return Env(outer, args=bind(outer, made.call, place), this=this, made=instance, depth=env.depth + 1)


def _is_whole(maker: Invocation) -> bool:
    """Whether a variable is given what the call returns, and not what is made of it."""
    value = maker.statement.value
    return isinstance(value, Call) and value.line == maker.line and value.args == maker.args
