"""Statements that call something on one side of a choice only: `self.rename() if test else None`, `test and put(x)`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

from ecm_parsers.source.expr import Call, Expr, Op

from ecm_extract.infer.branching import Branching
from ecm_extract.infer.calling import Calling
from ecm_extract.infer.held import State, joined_states
from ecm_extract.infer.run import Frame
from ecm_extract.link.code.walk import calls_in, children, perhaps_called

_CHOICES: Final = frozenset({"?:", "&&", "||"})
MAX_CHOICES: Final = 4
"""Choices within one statement of which each side is followed; beyond, nobody knows what is called there."""


class Choosing:
    """Applies what the calls of a statement do, on each side of the choices that they stand in."""

    def __init__(self, frame: Frame, calling: Calling, branching: Branching) -> None:
        self.frame = frame
        self.calling = calling
        self.branching = branching

    def after(self, at: int, state: State) -> State:
        """Return the state after the calls of a statement."""
        value = self.frame.body[at].value
        perhaps = list(perhaps_called(value)) if self.frame.env.func.calls[at] else []
        if not perhaps or not self._matters(at, perhaps, state):
            return self.calling.after(at, state, self.frame.place(state))
        return self._over(list(_outermost(value)), at, state, [], MAX_CHOICES)

    def _matters(self, at: int, perhaps: Sequence[Call], state: State) -> bool:
        """Whether any of some calls changes something."""
        own = self.frame.judge.own.of(self.frame.place(state))
        doing = (*(effect.call for effect in self.frame.effects.of(at)), *own)
        return any(call is each for call in doing for each in perhaps)

    def _over(self, choices: list[Op], at: int, state: State, skipped: list[Call], left: int) -> State:
        if not choices:
            return self.calling.after(at, state, self.frame.place(state), skipped)
        choice, *others = choices
        if not left:
            return self.calling.any_times(at, state, skipped)
        sides = self.branching.sides(choice.operands[0], state)
        taken, passed = _sides(choice)
        outs = [
            self._over([*_outermost(run), *others], at, side, [*skipped, *_calls(other)], left - 1)
            for side, run, other in ((sides.taken, taken, passed), (sides.passed, passed, taken))
            if side is not None
        ]
        return joined_states(outs) or state


def _sides(choice: Op) -> tuple[Expr | None, Expr | None]:
    """What runs where the test of a choice holds, and where it does not."""
    rest = choice.operands[1:]
    if choice.op == "?:":
        return rest[0], rest[1]
    further = rest[0] if len(rest) == 1 else Op(choice.op, rest)
    return (further, None) if choice.op == "&&" else (None, further)


def _calls(expr: Expr | None) -> list[Call]:
    return list(calls_in(expr)) if expr is not None else []


def _outermost(expr: Expr | None) -> Iterator[Op]:
    """Yield the choices of an expression that lie in no other one, and run anything on a side."""
    if isinstance(expr, Op) and expr.op in _CHOICES:
        yield from _outermost(expr.operands[0])
        if any(perhaps_called(expr)):
            yield expr
        return
    for part in children(expr) if expr is not None else ():
        yield from _outermost(part)
