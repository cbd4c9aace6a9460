"""Statements that may raise: what is known when handlers go on, and which runs come past them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_extract.infer.exits import Exits
from ecm_extract.infer.held import State
from ecm_extract.infer.memory import Memory
from ecm_extract.infer.routes import Raising
from ecm_extract.infer.run import Frame

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Env


class RaisingStatements:
    """Tells where runs go on behind statements that may raise.

    Whether one of which that can be known does is decided when somebody wants to know, and at once in the rounds of a
    loop.
    """

    def __init__(self, frame: Frame, exits: Exits, memory: Memory) -> None:
        self.frame = frame
        self.exits = exits
        self.memory = memory

    def past(self, at: int, env: Env, before: State, after: State) -> State | None:
        """Return the state behind a statement where it does not raise; None where it surely does.

        Args:
            at: the statement.
            env: its place.
            before: the state in front of it.
            after: the state behind its calls.
        """
        if at not in self.frame.outline.risks:
            return after
        if not self.frame.whole or not self._may_be_proved(at):
            self._may_raise(at, before, after)
            return after
        raising = Raising(env)
        if self.frame.rounds:
            holds = self.frame.judge.decided(raising).holds
            if holds is None:
                self._may_raise(at, before, after)
            if holds is not True:
                return after
        for state in self._meanwhile(at, before, after):
            self.exits.raised(state.through(raising, True), raising)
        return None if self.frame.rounds else after.through(raising, False)

    def _may_be_proved(self, at: int) -> bool:
        """Whether it can be known that a statement raises: of what it calls where that ends a round, or is handled."""
        asked = self.exits.catches or self.frame.rounds > 0
        return self.frame.judge.exceptions.is_provable(self.frame.env.func, at, asked)

    def _may_raise(self, at: int, before: State, after: State) -> None:
        if not self.exits.catches:
            self.frame.run.risky = True
            return
        for state in self._meanwhile(at, before, after):
            self.exits.may_raise(state)

    def _meanwhile(self, at: int, before: State, after: State) -> Iterator[State]:
        """The states in which a statement may raise: at first, on the way through what it calls, in the end."""
        yield before
        lasting = self.frame.judge.lasting.keys(self.frame.env.func, at)
        if lasting:
            yield self.memory.lost(before, lasting)
        if after.holds is not before.holds:
            yield after
