"""Functions that surely may return what is untold (see `untold`), or true as well as false."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Constant, Expr
from ecm_parsers.source.flow import Attempt, Block, Branch, Later, Leave, Loop, Step, Switch, blocks

if TYPE_CHECKING:
    from ecm_extract.link.code.units import Func
    from ecm_extract.link.running.untold import Untold

_BOTH: Final = frozenset({"true", "false"})


def gives_untold(func: Func, untold: Untold) -> bool:
    """Tell whether a function returns something untold where a run may come whatever is told, or true and false."""
    if "generator" in func.fact.traits or not func.fact.body:
        return False
    walk = _Walk(func, untold)
    walk.through(func.fact.flow or tuple(range(len(func.fact.body))))
    return walk.is_open or walk.constants >= _BOTH


class _Walk:
    """Goes through a body as far as runs may come whatever is told: past tests that nothing decides.

    Attributes:
        is_open: whether something untold is returned there.
        constants: the constants that are.
    """

    def __init__(self, func: Func, untold: Untold) -> None:
        self.func = func
        self.untold = untold
        self.is_open = False
        self.constants: set[str] = set()

    def through(self, block: Block) -> bool:
        """Take steps in order; tell whether runs may come past them."""
        return all(self._past(step) for step in block)

    def _past(self, step: Step) -> bool:
        match step:
            case int():
                return self._statement(step)
            case Later():
                return True
            case Leave():
                return False
            case Attempt():
                return self._attempt(step)
            case Loop():
                return self._rounds(step)
            case Branch():
                return self._sides(step, self._is_untold(step.test))
        tests = [test for case in step.cases for test in case.tests]
        return self._sides(step, self._is_untold(step.subject) or all(map(self._is_untold, tests)))

    def _statement(self, at: int) -> bool:
        statement = self.func.fact.body[at]
        if statement.kind != "return":
            return True
        if isinstance(statement.value, Constant):
            self.constants.add(statement.value.name)
        elif statement.value is not None and self.untold.has(statement.value, self.func, at):
            self.is_open = True
        return False

    def _sides(self, step: Branch | Switch, is_untold: bool) -> bool:
        if not is_untold:
            return not self._may_leave(step)
        sides = [self.through(block) for block in blocks(step)]
        return any(sides) or isinstance(step, Switch)

    def _rounds(self, step: Loop) -> bool:
        if not self._are_untold(step):
            return not self._may_leave(step)
        self.through(step.body)
        return True

    def _are_untold(self, step: Loop) -> bool:
        """Whether nothing tells how many rounds a loop has."""
        over = self.func.fact.body[step.each].value if step.each >= 0 else None
        if over is not None:
            return self.untold.has_within(over, self.func, step.each)
        return step.test is not None and self._is_untold(step.test)

    def _attempt(self, step: Attempt) -> bool:
        past = [self.through((*step.body, *step.other)), *[self.through(each.body) for each in step.handlers]]
        return any(past) and self.through(step.final)

    def _is_untold(self, test: Expr) -> bool:
        return self.untold.has(test, self.func, len(self.func.fact.body))

    def _may_leave(self, step: Step) -> bool:
        """Whether a run may leave the function, or a loop around, within a step."""
        if isinstance(step, int):
            return self.func.fact.body[step].kind == "return"
        inner = () if isinstance(step, Later | Leave) else blocks(step)
        return isinstance(step, Leave) or any(self._may_leave(entry) for block in inner for entry in block)
