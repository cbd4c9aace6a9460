"""What the parameters of a function are at a call.

Source: "Calls" of the Python language reference: `*values` and `**table` are spread among the parameters, and what is
left over stands in `*args` and `**kwargs`. Where the tree does not show what is spread, no default is known to hold.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op, Opaque, Table, Text
from msgspec.structs import replace

from ecm_extract.infer.held import Held, State
from ecm_extract.infer.places import whole_of
from ecm_extract.link.code.calls import PLACEHOLDER, Invocation, spreads, taken_by
from ecm_extract.link.code.left_alone import SPREAD, SPREAD_KEY, is_spread, mentions, reads_only
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.env import Bound, Env

MAX_HANDED: Final = 8
"""Functions that hand on what they are given, each to the next."""


class _Given(NamedTuple):
    """What a call gives, in order and by name; `rest` and `table` are what it spreads that is not shown."""

    placed: list[Bound]
    named: dict[str, Bound]
    rest: Bound | None = None
    table: Bound | None = None


def bind(callee: Func, call: Invocation, env: Env) -> dict[str, Bound]:
    """Return what the parameters of `callee` are at a call: arguments, keywords, then defaults; open if wrapped."""
    if callee.is_wrapped:
        names = [parameter.name.lstrip("*") for parameter in callee.params]
        return {name: Bound(Opaque(name), Env(callee, depth=env.depth)) for name in names}
    taken = taken_by(callee, call)
    given = _given(call if taken is call.args else replace(call, args=taken), env)
    own = {parameter.name for parameter in callee.params}
    bound: dict[str, Bound] = {}
    rest = given.placed
    for parameter in callee.params:
        if parameter.name.startswith(SPREAD):
            bound[parameter.name.lstrip("*")] = _left_over(own, given, env)
        elif parameter.name.startswith("*"):
            bound[parameter.name[1:]] = _in_order(given, rest, env)
            rest = []
        elif rest:
            bound[parameter.name] = rest[0]
            rest = rest[1:]
    bound |= {name: value for name, value in given.named.items() if name in own}
    more = _open(given.rest) if given.rest is not None else given.table
    if more is not None:
        for parameter in callee.params:
            bound.setdefault(parameter.name.lstrip("*"), more)
    elif len(bound) < len(callee.params):
        for name, default in callee.defaults:
            kept = isinstance(default, Items | Table | Call) and _is_touched(callee, name)
            bound.setdefault(name, Bound(Opaque(name) if kept else default, Env(callee, depth=env.depth)))
    return bound


def _is_touched(callee: Func, name: str) -> bool:
    """Tell whether a function of Python may change what a parameter has by default, which calls before have left so."""
    if callee.file.language != "python":
        return False
    for statement in callee.fact.body:
        asked = statement.value.callee if isinstance(statement.value, Call) else None
        targets = (statement.target, asked.base if isinstance(asked, Member) else None)
        if any(isinstance(each, Op | Member) and whole_of(each) == Name(name) for each in targets):
            return True
        if Name(name) in targets and (statement.kind == "do" or statement.type.endswith("=")):
            return True
    return False


def is_left_alone(func: Func, name: str) -> bool:
    """Tell whether a function of Python only reads a parameter, or spreads it, and nobody else can change it."""
    inner = [each for each in func.file.facts.functions if f"{each.scope}::".startswith(f"{func.inner_scope}::")]
    if any(mentions(step, name) for each in inner for step in each.body):
        return False
    return all(reads_only(step, name) for step in func.fact.body)


def _given(call: Invocation, env: Env) -> _Given:
    if not spreads(call):
        named = {name: Bound(value, env) for name, value in call.keywords}
        return _Given([Bound(arg, env) for arg in call.args], named)
    found = _Given([], {})
    for arg in call.args:
        found = _with_argument(found, Bound(arg, env))
    for name, value in call.keywords:
        found = _with_keyword(found, name, Bound(value, env))
    return found


def _with_argument(found: _Given, arg: Bound) -> _Given:
    if found.rest is not None:
        return found
    if not isinstance(arg.expr, Op) or not is_spread(arg.expr):
        found.placed.append(arg)
        return found
    spread = handed_on(Bound(arg.expr.operands[0], arg.env), _at_call)
    if not isinstance(spread.expr, Items):
        return found._replace(rest=spread)
    for item in spread.expr.items:
        found = _with_argument(found, Bound(item, spread.env))
    return found


def _with_keyword(found: _Given, name: str, value: Bound) -> _Given:
    if name != SPREAD:
        found.named[name] = value
        return found
    spread = handed_on(value, _at_call)
    if not isinstance(spread.expr, Table):
        return found._replace(table=_open(spread))
    for key, each in spread.expr.entries:
        if isinstance(key, Text):
            found.named[key.value] = Bound(each, spread.env)
        elif key == SPREAD_KEY:
            found = _with_keyword(found, SPREAD, Bound(each, spread.env))
        else:
            return found._replace(table=Bound(Opaque(SPREAD), spread.env))
    return found


def handed_on(value: Bound, argument: Callable[[str, Env], Bound | None]) -> Bound:
    """Return what `argument` gives for a parameter that is only handed on; anything else as it is."""
    for _ in range(MAX_HANDED):
        name = value.expr.id if isinstance(value.expr, Name) else ""
        is_handed_on = name in value.env.func.given and is_left_alone(value.env.func, name)
        given = argument(name, value.env) if is_handed_on else None
        if given is None:
            break
        value = given
    return value


def _at_call(name: str, env: Env) -> Bound | None:
    return env.args.get(name)


def _open(value: Bound) -> Bound:
    """What is spread that is not shown: what the function at hand is given beyond its parameters, or nobody knows."""
    name = value.expr.id if isinstance(value.expr, Name) else ""
    rest = any(parameter.name in {f"*{name}", f"**{name}"} for parameter in value.env.func.fact.params)
    unknown = name in value.env.args or not rest
    return Bound(Opaque(SPREAD) if unknown else value.expr, value.env.entry())


def _stays_open(value: Bound) -> Bound:
    """What the function at hand is given beyond its parameters, as it begins; anything else as it is at its place."""
    opened = _open(value)
    return value if isinstance(opened.expr, Opaque) else opened


def _in_order(given: _Given, rest: list[Bound], env: Env) -> Bound:
    """The list of arguments that no parameter stands for."""
    more = [_stays_open(given.rest)] if given.rest is not None else []
    names, place = _at_one_place([*rest, *more], env)
    return Bound(Items((*names[: len(rest)], *[Op("*", (each,)) for each in names[len(rest) :]])), place)


def _left_over(own: set[str], given: _Given, env: Env) -> Bound:
    """The table of keywords that no parameter has the name of."""
    left = {name: value for name, value in given.named.items() if name not in own}
    more = {SPREAD: given.table} if given.table is not None else {}
    values, place = _at_one_place([*left.values(), *more.values()], env)
    keys: list[Expr] = [*[Text(name) for name in left], *[SPREAD_KEY for _ in more]]
    return Bound(Table(tuple(zip(keys, values, strict=True))), place)


def _at_one_place(values: list[Bound], env: Env) -> tuple[list[Expr], Env]:
    """Expressions of several places as those of one, which names what they are."""
    place = values[0].env if values else env
    if all(each.env is place for each in values):
        return [each.expr for each in values], place
    names = [f"{PLACEHOLDER}{at}" for at in range(len(values))]
    held = {name: (Held("value", name, each.expr, each.env),) for name, each in zip(names, values, strict=True)}
    return [Name(name) for name in names], env.within(State().having(held), env.at)
