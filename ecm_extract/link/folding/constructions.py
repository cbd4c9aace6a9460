"""How objects of structures are made: what their constructors get, which values are for which fields."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec
from ecm_parsers.source.expr import Call, Expr, Items, Name, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.calls import Invocation, Step, construction, dotted_name
from ecm_extract.link.code.numbers import as_number, kind_of_type
from ecm_extract.link.code.pointed import given_to_pointed
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.link.code.units import Cls
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import Value, constant, demoted, literal


def construction_of(cls: Cls, made: Items | Call, env: Env) -> Invocation:
    """Return the call of a constructor: braces and parentheses say the same."""
    step = Step(env.func, env.at, Statement("do", cls.fact.line, None))
    call = construction(step, cls.fact.name, made.items if isinstance(made, Items) else given_of(made), cls.fact.line)
    return call if isinstance(made, Items) else msgspec.structs.replace(call, keywords=made.keywords)


def given_of(made: Call) -> tuple[Expr, ...]:
    """Return what the constructor gets of the arguments of a call that makes an object."""
    return given_to_pointed(last_name(dotted_name(made.callee)), made.args)


def named_parts(parts: Sequence[Bound]) -> Iterator[tuple[str, Bound]]:
    """Yield field -> value of those that say for which field they are: `Row{.name = "a"}`."""
    for part in parts:
        if isinstance(part.expr, Op) and part.expr.op == ".=" and isinstance(part.expr.operands[0], Name):
            yield part.expr.operands[0].id, Bound(part.expr.operands[1], part.env)


def left_empty(written: str) -> tuple[Value, ...]:
    """Return what a field is that begins with nothing: an empty text, zero; nothing is told of other types."""
    kind, last = kind_of_type(written), plain(written).rsplit("::", 1)[-1]
    if not kind or "*" in written or "&" in written or "[" in written:
        return ()
    if kind == "text":
        return (literal("")._replace(confidence="folded"),)
    return demoted((constant(False if last == "bool" else as_number(0, last)),))
