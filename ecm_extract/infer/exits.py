"""The ways out of blocks: to the end of a loop, to its next round, to a handler, out of the function."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from ecm_extract.infer.held import State
from ecm_extract.infer.run import Frame


class Exits:
    """Collects the states in which blocks are left, for where they go on.

    Args:
        frame: the function that is run; its run keeps the `return` statements.
    """

    def __init__(self, frame: Frame) -> None:
        self._frame = frame
        self._breaks: list[list[State]] = []
        self._continues: list[list[State]] = []
        self._raised: list[list[State]] = []
        self.left: list[State] = []

    def leave(self, how: str, state: State) -> None:
        """Take the way out that a step is: `break`, `continue`, `throw`, `return`."""
        if how == "break" and self._breaks:
            self._breaks[-1].append(state)
        elif how == "continue" and self._continues:
            self._continues[-1].append(state)
        elif how == "throw":
            self.may_raise(state)
        elif how == "return" and not self._frame.later:
            self.left.append(state)

    @property
    def catches(self) -> bool:
        """Whether a handler is around, for which it matters what raises."""
        return bool(self._raised)

    def may_raise(self, state: State) -> None:
        """Note a state in which a handler around may go on."""
        for frame in self._raised:
            frame.append(state)

    def returned(self, at: int, state: State, after: State) -> None:
        """Note a `return` statement that is reached; that of a lambda leaves the lambda only.

        Args:
            at: the statement.
            state: where its value is evaluated.
            after: what it leaves.
        """
        if not self._frame.later:
            self._frame.run.returns.append((at, state))
            self.left.append(after)

    @property
    def ways_out(self) -> int:
        """How many ways have left the function so far."""
        return len(self.left)

    # --- what is around ----------------------------------------------------------------------------------

    def enter_loop(self) -> None:
        """From here on `break` and `continue` mean this loop."""
        self._breaks.append([])
        self._continues.append([])

    def broken(self) -> int:
        """Return how many ways leave the loop at hand so far."""
        return len(self._breaks[-1])

    def next_round(self) -> list[State]:
        """Return, once, the states in which rounds of the loop at hand ended early."""
        found = self._continues[-1]
        self._continues[-1] = []
        return found

    def end_loop(self) -> list[State]:
        """Return the states in which the loop at hand was left."""
        self._continues.pop()
        return self._breaks.pop()

    def enter_switch(self) -> None:
        """From here on `break` means this switch."""
        self._breaks.append([])

    def end_switch(self) -> list[State]:
        """Return the states in which the switch at hand was left."""
        return self._breaks.pop()

    def enter_attempt(self) -> None:
        """From here on, what is raised goes to the handlers of this attempt."""
        self._raised.append([])

    def end_attempt(self) -> list[State]:
        """Return the states in which something was raised."""
        return self._raised.pop()

    # --- code of its own ---------------------------------------------------------------------------------

    @contextmanager
    def within_lambda(self) -> Iterator[None]:
        """Within it, loops and handlers around mean nothing."""
        keep = (self._breaks, self._continues, self._raised)
        self._breaks, self._continues, self._raised = [[]], [[]], []
        yield
        self._breaks, self._continues, self._raised = keep

    @contextmanager
    def unreached(self) -> Iterator[None]:
        """Within it, no way out leads anywhere."""
        left, returns = self.left, self._frame.run.returns
        self.left, self._frame.run.returns = [], []
        with self.within_lambda():
            yield
        self.left, self._frame.run.returns = left, returns
