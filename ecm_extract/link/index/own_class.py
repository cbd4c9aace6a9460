"""Objects of Python that a method makes of its own class, whatever that is called: `cls(x)`, `type(self)(x)`."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation, Step, invocation
from ecm_extract.link.code.decorators import is_of_class
from ecm_extract.link.code.units import Func
from ecm_extract.link.index.program import Program


def of_own_class(func: Func, program: Program) -> Iterator[Invocation]:
    """Yield the calls of a method that make an object of its class, which no other derives from."""
    cls = func.cls
    if cls is None or cls.file.language != "python" or program.derived(cls):
        return
    for at, (statement, calls) in enumerate(zip(func.fact.body, func.calls, strict=True)):
        for call in calls:
            if is_own_class(call.callee, func):
                path = cls.qualified.replace("::", ".")
                yield replace(invocation(Step(func, at, statement), call), path=path, receiver=None)


def is_own_class(expr: Expr, func: Func) -> bool:
    """Tell whether an expression in a method is the class of its object, or the one that it is called on."""
    if expr == Member(THIS, "__class__"):
        return True
    asked = isinstance(expr, Call) and expr.callee == Name("type") and expr.args == (THIS,)
    return asked or (expr == THIS and is_of_class(func))
