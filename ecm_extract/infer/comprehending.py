"""Comprehensions that call something: their statement is reached once for each element."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from ecm_parsers.source.expr import Comprehension, Expr
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.assigning import Assigning
from ecm_extract.infer.held import State
from ecm_extract.infer.looping import MAX_ROUNDS
from ecm_extract.infer.routes import NOWHERE
from ecm_extract.infer.run import Frame
from ecm_extract.link.code.walk import comprehensions


class Comprehending:
    """Keeps the loops of comprehensions until the statement that they stand in."""

    def __init__(self, frame: Frame, assigning: Assigning) -> None:
        self.frame = frame
        self.assigning = assigning
        self._pending: list[int] = []

    def begin(self, at: int) -> None:
        """Note a loop of a comprehension that stands in a later statement."""
        self._pending.append(at)

    def states(self, statement: Statement, at: int, state: State) -> list[State]:
        """The states of a statement with comprehensions: one for each element, where it calls anything."""
        if not self._pending:
            return [state]
        found = list(comprehensions(statement.value))
        states = [state]
        for entry in found if self.frame.env.func.calls[at] else ():
            states = [inner for outer in states for inner in self._elements(entry, outer)]
        done = {loop for entry in found for loop in entry.loops}
        self._pending = [loop for loop in self._pending if loop not in done] if found else self._pending
        if not found:
            states = self._asked(statement, at, state)
        return states or [replace(state, route=NOWHERE)]

    def _asked(self, statement: Statement, at: int, state: State) -> list[State]:
        """The states of a condition of a comprehension: one for each element that conditions before it let pass."""
        whole = next((entry for later in self.frame.body[at + 1 :] for entry in comprehensions(later.value)), None)
        states = [state]
        if whole is None or statement.value not in whole.tests or not {*self._pending} <= {*whole.loops}:
            for loop in self._pending:
                states = [self.assigning.element(self.frame.body[loop], loop, entry) for entry in states]
            return states
        for loop in self._pending:
            states = [inner for outer in states for inner in self._each_of(loop, outer)]
        before = whole.tests[: whole.tests.index(statement.value)]
        return [kept for one in states if (kept := self._passing(before, one)) is not None]

    def _elements(self, entry: Comprehension, state: State) -> list[State]:
        states = [state]
        for loop in entry.loops:
            states = [inner for outer in states for inner in self._each_of(loop, outer)]
        return [kept for one in states if (kept := self._passing(entry.tests, one)) is not None]

    def _each_of(self, loop: int, state: State) -> list[State]:
        each = self.frame.body[loop]
        known = self.frame.whole and each.value is not None
        items = (
            self.frame.judge.rounds(each.value, self.frame.place(state)) if known and each.value is not None else None
        )
        if items is None or len(items) > MAX_ROUNDS:
            return [self.assigning.element(each, loop, state)]
        return [self.assigning.known_element(each.target, item, loop, state) for item in items]

    def _passing(self, tests: Sequence[Expr], state: State) -> State | None:
        found = [self.frame.truth(test, state) for test in tests]
        if False in found:
            return None
        return self.frame.undecided(state) if None in found else state
