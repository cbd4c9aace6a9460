"""Which declaration of a variable of C++ is seen at a statement, where blocks of a function declare several of a name.

Source: [basic.scope.block]: a variable is seen from its declaration to the end of its block, unless another hides it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ecm_parsers.source.flow import Block, Loop, blocks, statements

from ecm_extract.link.code.units import Func


class VisibleVariables:
    """Answers it, with the blocks of each function looked at once."""

    def __init__(self) -> None:
        self._ends: dict[Func, Mapping[int, int]] = {}

    def declared(self, func: Func, places: Sequence[int], at: int) -> int | None:
        """Return which of the statements that declare a variable is the one seen at a statement; None for none.

        Args:
            func: the function.
            places: its statements that declare a variable of the name, in order.
            at: the statement.
        """
        ends = self._ends.get(func)
        if ends is None:
            ends = self._ends[func] = dict(_ends(func.fact.flow))
        last = len(func.fact.body)
        return next((each for each in reversed(places) if each <= at <= max(ends.get(each, last), each)), None)


def _ends(block: Block) -> Iterator[tuple[int, int]]:
    """Yield the statements within the blocks of a block, each with the last one of the block that it stands in."""
    for step in block:
        if isinstance(step, int):
            continue
        if isinstance(step, Loop) and step.each >= 0:
            yield step.each, max(statements((step,)), default=step.each)
        for inner in blocks(step):
            end = max(statements(inner), default=-1)
            yield from ((each, end) for each in inner if isinstance(each, int))
            yield from _ends(inner)
