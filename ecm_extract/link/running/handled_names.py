"""Names of Python that are read where a handler goes on if they are not bound: `try: x = A`, `except NameError:`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Expr, Items, Name
from ecm_parsers.source.flow import Attempt, Block, Branch, Loop, blocks, statements

from ecm_extract.infer.kinds import Exceptions, standard_kind
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import names_in

_RAISED: Final = standard_kind("UnboundLocalError", "python")
"""What reading a variable raises that has nothing; it derives from `NameError`."""


def handled_names(func: Func, exceptions: Exceptions) -> frozenset[str]:
    """Return the names that a function reads within a `try` whose handlers are for names that are not bound."""
    bodies = (step.body for step in _attempts(func.fact.flow or ()) if _handles(step, func, exceptions))
    return frozenset(name for body in bodies for expr in _read(body, func) for name in names_in(expr))


def _attempts(block: Block) -> Iterator[Attempt]:
    for step in block:
        if isinstance(step, int):
            continue
        if isinstance(step, Attempt):
            yield step
        for inner in blocks(step):
            yield from _attempts(inner)


def _handles(step: Attempt, func: Func, exceptions: Exceptions) -> bool:
    """Whether a handler is for it by its own type or a base of it, which no type of others is."""
    types = [tuple([exceptions.kind(name, func) for name in each.types]) for each in step.handlers]
    return any(not kinds or any(_RAISED and kind and _RAISED.fits(kind) for kind in kinds) for kinds in types)


def _read(block: Block, func: Func) -> Iterator[Expr]:
    """What the statements and conditions of a block read."""
    for at in statements(block):
        statement = func.fact.body[at]
        target = (
            statement.target if not isinstance(statement.target, Name | Items) else None
        )  # binds, and reads nothing
        yield from (expr for expr in (target, statement.value) if expr is not None)
    yield from _tests(block)


def _tests(block: Block) -> Iterator[Expr]:
    for step in block:
        if isinstance(step, Branch | Loop) and step.test is not None:
            yield step.test
        for inner in () if isinstance(step, int) else blocks(step):
            yield from _tests(inner)
