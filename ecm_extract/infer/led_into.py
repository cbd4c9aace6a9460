"""Variables of Python that calls get parts of without naming them: `f(table.get("a"))`, `f(*rows)`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set

from ecm_parsers.source.expr import Call, Expr, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.bare_names import shared_names
from ecm_extract.link.code.walk import given_to, last_of


def led_into(call: Call, giving: Set[str], body: Sequence[Statement]) -> Iterator[Expr]:
    """Yield the variables of which arguments of a call may be parts.

    Args:
        call: the call.
        giving: functions and methods that give parts of what they get, or are called on.
        body: the statements of its function.
    """
    for given in given_to(call):
        arg = _indexed(given)
        if isinstance(arg, Op) and arg.op == "*" and len(arg.operands) == 1:
            yield from shared_names(arg.operands[0], body)
        elif isinstance(arg, Call) and last_of(arg.callee) in giving:
            yield from shared_names(arg, body)


def _indexed(arg: Expr) -> Expr:
    """What an element is taken of: `list(rows)` of `list(rows)[0]`; itself where it is none."""
    while isinstance(arg, Op) and arg.op == "[]":
        arg = arg.operands[0]
    return arg
