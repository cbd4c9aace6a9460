"""Names of Python that are read where a handler goes on if they are not bound: `try: x = A`, `except NameError:`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Expr, Items, Name
from ecm_parsers.source.flow import Attempt, Block, Branch, Loop, statements, steps

from ecm_extract.infer.kinds import Exceptions, standard_kind
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import names_in

_RAISED: Final = standard_kind("UnboundLocalError", "python")
"""What reading a variable raises that has nothing; it derives from `NameError`."""


def handled_names(func: Func, exceptions: Exceptions) -> frozenset[str]:
    """Return the names that a function reads within a `try` whose handlers are for names that are not bound."""
    attempts = (step for step in steps(func.fact.flow or ()) if isinstance(step, Attempt))
    bodies = (step.body for step in attempts if _handles(step, func, exceptions))
    return frozenset(name for body in bodies for expr in _read(body, func) for name in names_in(expr))


def _handles(step: Attempt, func: Func, exceptions: Exceptions) -> bool:
    """Whether a handler is for it by its own type or a base of it, which no type of others is."""
    types = [tuple([exceptions.kind(name, func) for name in each.types]) for each in step.handlers]
    return any(not kinds or any(_RAISED and kind and _RAISED.fits(kind) for kind in kinds) for kinds in types)


def _read(block: Block, func: Func) -> Iterator[Expr]:
    """What the statements and conditions of a block read."""
    for at in statements(block):
        statement = func.fact.body[at]
        is_bound = isinstance(statement.target, Name | Items)  # which reads nothing
        read = (None if is_bound else statement.target, statement.value)
        yield from (expr for expr in read if expr is not None)
    yield from (step.test for step in steps(block) if isinstance(step, Branch | Loop) and step.test is not None)
