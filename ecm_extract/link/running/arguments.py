"""What the parameters of a function are at a call.

Source: "Calls" of the Python language reference: `*values` and `**table` are spread among the parameters, and what is
left over stands in `*args` and `**kwargs`. Where the tree does not show what is spread, no default is known to hold.
"""

from __future__ import annotations

from typing import NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op, Opaque, Table, Text

from ecm_extract.infer.places import whole_of
from ecm_extract.link.code.calls import SPREAD, Invocation, is_spread, spreads
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.env import Bound, Env


class _Given(NamedTuple):
    """What a call gives, in order and by name; with `is_open` it gives more that is not known."""

    placed: list[Bound]
    named: dict[str, Bound]
    is_open: bool


def bind(callee: Func, call: Invocation, env: Env) -> dict[str, Bound]:
    """Return what the parameters of `callee` are at a call: arguments, keywords, then defaults."""
    given = _given(call, env)
    bound: dict[str, Bound] = {}
    rest = given.placed
    for parameter in callee.params:
        if parameter.name.startswith(SPREAD):
            bound[parameter.name.lstrip("*")] = _left_over(callee, given, env)
        elif parameter.name.startswith("*"):
            bound[parameter.name[1:]] = _in_order(given, rest, env)
            rest = []
        elif rest:
            bound[parameter.name] = rest[0]
            rest = rest[1:]
    bound |= given.named
    if given.is_open:
        for parameter in callee.params:
            bound.setdefault(parameter.name.lstrip("*"), Bound(Opaque(SPREAD), env))
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


def _given(call: Invocation, env: Env) -> _Given:
    if not spreads(call):
        named = {name: Bound(value, env) for name, value in call.keywords}
        return _Given([Bound(arg, env) for arg in call.args], named, is_open=False)
    found = _Given([], {}, is_open=False)
    for arg in call.args:
        found = _with_argument(found, arg, env)
    for name, value in call.keywords:
        found = _with_keyword(found, name, value, env)
    return found


def _with_argument(found: _Given, arg: Expr, env: Env) -> _Given:
    if not isinstance(arg, Op) or not is_spread(arg):
        if not found.is_open:
            found.placed.append(Bound(arg, env))
        return found
    spread = _shown(arg.operands[0], env)
    if not isinstance(spread.expr, Items) or found.is_open:
        return found._replace(is_open=True)
    for item in spread.expr.items:
        found = _with_argument(found, item, spread.env)
    return found


def _with_keyword(found: _Given, name: str, value: Expr, env: Env) -> _Given:
    if name != SPREAD:
        found.named[name] = Bound(value, env)
        return found
    spread = _shown(value, env)
    entries = spread.expr.entries if isinstance(spread.expr, Table) else ((value, value),)
    for key, each in entries:
        if not isinstance(key, Text):
            return found._replace(is_open=True)
        found.named[key.value] = Bound(each, spread.env)
    return found


def _shown(expr: Expr, env: Env) -> Bound:
    """A display, or the one that a parameter of the function at hand stands for."""
    given = env.args.get(expr.id) if isinstance(expr, Name) and expr.id in env.func.given else None
    return given if given is not None else Bound(expr, env)


def _in_order(given: _Given, rest: list[Bound], env: Env) -> Bound:
    """The list of arguments that no parameter stands for."""
    place = rest[0].env if rest else env
    if given.is_open or any(each.env is not place for each in rest):
        return Bound(Opaque("*"), env)
    return Bound(Items(tuple([each.expr for each in rest])), place)


def _left_over(callee: Func, given: _Given, env: Env) -> Bound:
    """The table of keywords that no parameter has the name of."""
    own = {parameter.name for parameter in callee.params}
    left = {name: value for name, value in given.named.items() if name not in own}
    if given.is_open or any(value.env is not env for value in left.values()):
        return Bound(Opaque(SPREAD), env)
    return Bound(Table(tuple([(Text(name), value.expr) for name, value in left.items()])), env)
