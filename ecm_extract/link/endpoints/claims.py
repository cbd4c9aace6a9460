"""Hardware interfaces that a controller asks for: what its `*_interface_configuration` methods list.

Source: ros2_control `controller_interface::InterfaceConfiguration`. A parameter may give a part of a name; a list
parameter gives one claim for each of its items.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, NamedTuple

from ecm_checker.contract import Evidence
from ecm_checker.hub.local_name import Parts
from ecm_parsers.source.expr import Call, Expr, Items, Member

from ecm_extract.link.code.calls import Invocation, invocations
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import calls_in, last_of
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.naming.local_names import parts_of
from ecm_extract.link.running.env import Env, Instance
from ecm_extract.link.running.values import Value

_METHODS: tuple[tuple[str, Literal["command", "state"]], ...] = (
    ("command_interface_configuration", "command"),
    ("state_interface_configuration", "state"),
)
_ADDERS = frozenset({"push_back", "emplace_back", "insert"})
MAX_CLAIMS = 200


class Claim(NamedTuple):
    """One hardware interface, or all of them (`*`), that a controller commands or reads."""

    kind: Literal["command", "state"]
    name: Parts
    evidence: Evidence


def claims_of(cls: Cls, folder: Folder) -> tuple[Claim, ...] | None:
    """Return what a class claims, None when it is no controller that says so."""
    found: dict[tuple[str, Parts], Claim] = {}
    methods = [(func, kind) for name, kind in _METHODS if (func := _method(cls, name, folder)) is not None]
    for func, kind in methods:
        for name, line in _listed(func, cls, folder):
            evidence = Evidence(func.file.path, line)
            found.setdefault((kind, name), Claim(kind, name, evidence))
    return tuple(found.values())[:MAX_CLAIMS] if methods else None


def _method(cls: Cls, name: str, folder: Folder) -> Func | None:
    for owner in folder.program.ancestry(cls):
        for method in owner.methods:
            if method.fact.name == name and method.fact.body:
                return method
    return None


def _listed(func: Func, cls: Cls, folder: Folder) -> Iterator[tuple[Parts, int]]:
    """Yield (name, line) of the interfaces that a method lists."""
    made = Instance(cls, {}, {})
    for at, statement in enumerate(func.fact.body):
        env = Env(func, at, this=cls, made=made)
        if statement.value is None:
            continue
        if any(last_of(part) == "ALL" for part in _names(statement.value)):
            yield ("*",), statement.line
        if statement.kind == "set" and last_of(statement.target) == "names":
            yield from ((parts_of(value), statement.line) for value in folder.lists.elements(statement.value, env))
        elif statement.kind == "return" and _second(statement.value) is not None:
            values = folder.lists.elements(_second(statement.value), env)
            yield from ((parts_of(value), statement.line) for value in values if _is_informative(value))
        yield from _added(func, at, env, folder)


def _added(func: Func, at: int, env: Env, folder: Folder) -> Iterator[tuple[Parts, int]]:
    """Names that one statement appends to a list."""
    statement = func.fact.body[at]
    for call in invocations(func, _ADDERS):
        if call.statement is not statement or not call.args:
            continue
        for value in _appended(call, env, folder):
            yield parts_of(value), call.line


def _appended(call: Invocation, env: Env, folder: Folder) -> tuple[Value, ...]:
    """`insert(end, other.begin(), other.end())` appends a whole list."""
    last = call.args[-1]
    if call.last == "insert" and isinstance(last, Call) and isinstance(last.callee, Member):
        return folder.lists.elements(last.callee.base, env)
    return folder.fold(last, env)


def _second(expr: Expr | None) -> Expr | None:
    """The list of `{type, list}`."""
    if isinstance(expr, Items) and len(expr.items) == 2:
        return expr.items[1]
    return expr.args[1] if isinstance(expr, Call) and len(expr.args) == 2 else None


def _is_informative(value: Value) -> bool:
    return bool(value.template) or value.confidence != "pattern"


def _names(expr: Expr) -> Iterator[Expr]:
    yield from (expr, *(expr.items if isinstance(expr, Items) else ()))
    for call in calls_in(expr):
        yield from call.args
