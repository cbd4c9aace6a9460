"""Methods that declare and that Python hands on as values: `use(self.create_publisher)`, `[self.create_client]`.

Whoever gets one may call it with anything: that is told as a call whose arguments nobody knows. One that only a
variable or a member holds is followed instead (see `callables`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Op, Opaque, Table
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.callables import object_of
from ecm_extract.link.code.calls import Invocation, Step
from ecm_extract.link.code.left_alone import SPREAD
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import children, given_to
from ecm_extract.link.declaring.forms import Form, FormTable

_ASKING = frozenset({"callable", "hasattr", "isinstance", "print", "repr", "str", "id", "hash"})
"""Functions that call nothing they are given."""


def handed_makers(forms: FormTable) -> frozenset[str]:
    """Return the methods of Python nodes that declare what they are asked for."""
    return frozenset(name for name, rows in forms.items() if any(map(_is_handed, rows)))


def escaping(funcs: Iterable[Func], makers: Collection[str]) -> Iterator[Invocation]:
    """Yield a call that nobody knows the arguments of for each method that is handed on."""
    python = [func for func in funcs if func.file.language == "python"]
    elsewhere = {name for func in python for name in _called_on_others(func)}
    for func in python:
        for at, statement in enumerate(func.fact.body):
            if not _is_followed(statement, func, elsewhere):
                for method in _handed(statement.value, func, makers):
                    yield _unknown(Step(func, at, statement), method)


def _is_handed(form: Form) -> bool:
    named = form.match == "method" and form.language == "python" and not form.receiver
    return named and not form.fixed and not form.undeclared


def _called_on_others(func: Func) -> Iterator[str]:
    """Yield the names of the methods that a function calls on anything but its object."""
    for call in (each for calls in func.calls for each in calls):
        if isinstance(call.callee, Member) and call.callee.base != THIS:
            yield call.callee.name


def _is_followed(statement: Statement, func: Func, elsewhere: Collection[str]) -> bool:
    """Tell whether a statement gives a method to a variable, or a member, whose calls are known."""
    target = statement.target
    if isinstance(target, Name):
        return target.id in func.callables.variables
    if not isinstance(target, Member) or target.base != THIS:
        return False
    return target.name in func.callables.members and target.name not in elsewhere


def _handed(expr: Expr | None, func: Func, makers: Collection[str]) -> Iterator[Member]:
    """Yield the methods among the values of an expression, without what it calls."""
    for part in _values(expr, func):
        held = func.callables.variables.get(part.id) if isinstance(part, Name) else part
        for method in _methods(held):
            if method.name in makers and object_of(method):
                yield method


def _methods(held: Expr | None) -> Iterator[Member]:
    if isinstance(held, Member):
        yield held
    elif isinstance(held, Table):
        for _, value in held.entries:
            yield from _methods(value)
    elif isinstance(held, Call) and held.args:
        yield from _methods(held.args[0])


def _values(expr: Expr | None, func: Func) -> Iterator[Name | Member]:
    if isinstance(expr, Name | Member):
        yield expr
        yield from _values(expr.base, func) if isinstance(expr, Member) else ()
    elif isinstance(expr, Call):
        yield from _values_of_call(expr, func)
    else:
        for part in children(expr) if expr is not None else ():
            yield from _values(part, func)


def _values_of_call(call: Call, func: Func) -> Iterator[Name | Member]:
    callee = call.callee
    if func.callables.meant(call) is call and not isinstance(callee, Name):
        yield from _values(callee.base if isinstance(callee, Member) else callee, func)
    if isinstance(callee, Name) and callee.id in _ASKING:
        return
    for part in given_to(call):
        yield from _values(part, func)


def _unknown(step: Step, method: Member) -> Invocation:
    anything = Opaque(SPREAD)
    return Invocation(
        *step, method.name, method.base, (Op("*", (anything,)),), ((SPREAD, anything),), (), step.statement.line
    )
