"""Branches of C++ that directives make: what is declared in one is a variable of the block around it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Expr, Op, Opaque
from ecm_parsers.source.flow import Block, Branch, blocks

_ASKED: Final = "#if "


def declared_beyond(block: Block) -> Iterator[int]:
    """Yield the statements of a block, at any depth, that stand right in a branch of a directive."""
    for step in block:
        if isinstance(step, int):
            continue
        if isinstance(step, Branch) and _is_directive(step.test):
            yield from (at for side in (step.then, step.other) for at in side if isinstance(at, int))
        for inner in blocks(step):
            yield from declared_beyond(inner)


def _is_directive(test: Expr) -> bool:
    if isinstance(test, Op):
        return any(map(_is_directive, test.operands))
    return isinstance(test, Opaque) and test.text.startswith(_ASKED)
