"""Comprehensions that call something: their statement is reached, and does what it calls, once for each element."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Comprehension, Expr
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.assigning import Assigning
from ecm_extract.infer.choosing import Choosing
from ecm_extract.infer.held import State
from ecm_extract.infer.routes import NOWHERE
from ecm_extract.infer.run import MAX_ITEMS, Frame
from ecm_extract.link.code.walk import comprehensions

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Bound


class Comprehending:
    """Keeps the loops of comprehensions until the statement that they stand in."""

    def __init__(self, frame: Frame, assigning: Assigning, choosing: Choosing) -> None:
        self.frame = frame
        self.assigning = assigning
        self.choosing = choosing
        self._pending: list[int] = []

    def begin(self, at: int) -> None:
        """Note a loop of a comprehension that stands in a later statement."""
        self.assigning.memory.sharing.enter(self.frame.body[at])
        self._pending.append(at)

    def after(self, statement: Statement, at: int, state: State) -> State:
        """Record the states in which a statement is reached, and return that after its calls."""
        found = list(comprehensions(statement.value)) if self._pending and self.frame.env.func.calls[at] else []
        if not found:
            self.frame.record(at, self._states(statement, at, state))
            return self.choosing.after(at, state)
        seen: list[State] = []
        alone = statement.kind == "do" and found == [statement.value]
        end = self._followed(found[0], found[0].loops, at, state, seen) if alone else None
        if end is not None:
            self._pending = [loop for loop in self._pending if loop not in found[0].loops]
            self.frame.record(at, seen or [replace(state, route=NOWHERE)])
        else:
            end = self._any_times(found, at, state)
            self.frame.record(at, self._states(statement, at, end))
        return self._unbound(found, state, end)

    def _followed(
        self, entry: Comprehension, loops: Sequence[int], at: int, state: State, seen: list[State]
    ) -> State | None:
        """The state after all rounds, one by one; None where they are not all known."""
        if not loops:
            found = [self.frame.truth(test, state) for test in entry.tests]
            if False in found or None in found:
                return state if False in found else None
            seen.append(state)
            return self.choosing.after(at, state)
        each = self.frame.body[loops[0]]
        items = self._known(each, state)
        if items is None:
            return None
        current: State | None = state
        for item in items:
            if current is not None:
                bound = self.assigning.known_element(each, item, loops[0], current)
                current = self._followed(entry, loops[1:], at, bound, seen)
        return current

    def _any_times(self, found: Sequence[Comprehension], at: int, state: State) -> State:
        """The state in which nobody knows what the calls of a statement change, which run any number of times."""
        inner = state
        for loop in (loop for entry in found for loop in entry.loops):
            inner = self.assigning.element(self.frame.body[loop], loop, inner)
        return self.choosing.calling.any_times(at, inner)

    def _bound(self, found: Sequence[Comprehension]) -> Iterator[str]:
        """The variables that comprehensions have for themselves."""
        for loop in (loop for entry in found for loop in entry.loops):
            yield from self.frame.outline.bound_keys(self.frame.body[loop].target)

    def _unbound(self, found: Sequence[Comprehension], before: State, after: State) -> State:
        """The state in which variables of comprehensions hold what others of their name held around them."""
        own = set(self._bound(found))
        held = {key for key in (*after.holds, *before.holds) if key.partition(".")[0] in own}
        return after.having({key: before.holds.get(key, ()) for key in held})

    def _states(self, statement: Statement, at: int, state: State) -> list[State]:
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
        items = self._known(each, state)
        if items is None:
            return [self.assigning.element(each, loop, state)]
        return [self.assigning.known_element(each, item, loop, state) for item in items]

    def _known(self, each: Statement, state: State) -> list[Bound] | None:
        """What a loop of a comprehension is over; None where not all of it is known, or some runs have more."""
        asked = self.frame.whole and each.value is not None
        rounds = self.frame.judge.rounds(each.value, self.frame.place(state)) if asked and each.value else None
        if rounds is None or len(rounds) > MAX_ITEMS or any(entry.path for entry in rounds):
            return None
        return [entry.item for entry in rounds]

    def _passing(self, tests: Sequence[Expr], state: State) -> State | None:
        found = [self.frame.truth(test, state) for test in tests]
        if False in found:
            return None
        return self.frame.undecided(state) if None in found else state
