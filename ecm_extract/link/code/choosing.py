"""What a statement asks on the way to a call in its value: `out = make() if wanted else None`, `wanted and make()`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from ecm_parsers.source.expr import Call, Expr, Op

from ecm_extract.link.code.calls import Invocation, Step, invocation
from ecm_extract.link.code.walk import children

_GOES_ON = {"&&": True, "||": False}


class Asked(NamedTuple):
    """A test, and whether it holds where the call is."""

    test: Expr
    holds: bool


def asked_before(call: Invocation) -> tuple[Asked, ...]:
    """Return the tests that stand between a statement and a call in it, outermost first."""
    value = call.statement.value
    return _way(value, call) or () if value is not None else ()


def _way(expr: Expr, call: Invocation) -> tuple[Asked, ...] | None:
    """The tests on the way to a call; None where it is not."""
    if isinstance(expr, Call) and _is(expr, call):
        return ()
    for part, asked in _parts(expr):
        way = _way(part, call)
        if way is not None:
            return (*asked, *way)
    return None


def _is(expr: Call, call: Invocation) -> bool:
    """Whether an expression is a call as the forms see it: two with the same arguments may stand side by side."""
    found = invocation(Step(call.func, call.at, call.statement), expr)
    return (found.path, found.receiver, found.line) == (call.path, call.receiver, call.line) and expr.args == call.args


def _parts(expr: Expr) -> Iterator[tuple[Expr, tuple[Asked, ...]]]:
    """The parts of an expression, each with what is asked before it is evaluated."""
    if isinstance(expr, Op) and expr.op == "?:" and len(expr.operands) == 3:
        test, then, other = expr.operands
        yield from ((test, ()), (then, (Asked(test, True),)), (other, (Asked(test, False),)))
    elif isinstance(expr, Op) and expr.op in _GOES_ON:
        holds = _GOES_ON[expr.op]
        for at, part in enumerate(expr.operands):
            yield part, tuple([Asked(each, holds) for each in expr.operands[:at]])
    else:
        yield from ((part, ()) for part in children(expr))
