"""The ways out of blocks: to the end of a loop, to its next round, to a handler, out of the function."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import NamedTuple

from ecm_extract.infer.held import Held, State, joined_states
from ecm_extract.infer.kinds import Kind, any_fits
from ecm_extract.infer.routes import Fitting, Raising
from ecm_extract.infer.run import Frame, Raised


@dataclass(slots=True, eq=False)
class Catching:
    """A handler, by the types that it is for, with what it gets; without types it is for all."""

    types: tuple[Kind | None, ...]
    caught: list[Raised] = field(default_factory=list)


@dataclass(slots=True, eq=False)
class Around:
    """What stands around a block: handlers, or what runs in the end.

    Attributes:
        handlers: the handlers; none where something runs in the end.
        passing: what surely raises and passes by what runs in the end. risky: what may raise and does so.
    """

    handlers: tuple[Catching, ...] = ()
    passing: list[Raised] = field(default_factory=list)
    risky: list[State] = field(default_factory=list)


class Reached(NamedTuple):
    """Ways out of blocks, each with how many states it had at a place, and how much was returned until then."""

    ways: Sequence[tuple[list[State], int]]
    returned: int


class Exits:
    """Collects the states in which blocks are left, for where they go on.

    Args:
        frame: the function that is run; its run keeps the `return` statements.
    """

    def __init__(self, frame: Frame) -> None:
        self._frame = frame
        self._breaks: list[list[State]] = []
        self._continues: list[list[State]] = []
        self._around: list[Around] = []
        self._handling: list[Kind | Raising | None] = []
        self.left: list[State] = []

    def leave(self, how: str, state: State) -> None:
        """Take the way out that a step is: `break`, `continue`, `return`."""
        if how == "break" and self._breaks:
            self._breaks[-1].append(state)
        elif how == "continue" and self._continues:
            self._continues[-1].append(state)
        elif how == "return" and not self._frame.later:
            self.left.append(state)

    def reached(self) -> Reached:
        """Return how many states left so far by `return`, and by `break` and `continue` of the loop at hand."""
        ways = (self.left, *self._breaks[-1:], *self._continues[-1:])
        return Reached(tuple([(way, len(way)) for way in ways]), len(self._frame.run.returns))

    def leave_through(self, reached: Reached, final: Callable[[State], State | None]) -> None:
        """Let what left since then run what stands in the end first, which may return something else instead."""
        told = self._frame.run.returns
        until = len(told)
        for way, count in reached.ways:
            leaving = joined_states(way[count:])
            del way[count:]  # what stands in the end may leave by the same way itself
            after = final(leaving) if leaving is not None else None
            way += [after] if after is not None else []
            if way is self.left and after is None:
                del told[reached.returned : until]

    # --- exceptions --------------------------------------------------------------------------------------

    @property
    def catches(self) -> bool:
        """Whether a handler is around, for which it matters what raises."""
        return bool(self._around)

    def thrown(self, state: State, spelled: str) -> None:
        """Note a state in which something is raised, by its type as written; without one, what is handled."""
        again = self._handling[-1] if self._handling and not spelled else None
        what = self._frame.judge.exceptions.kind(spelled, self._frame.env.func) if spelled else again
        self.raised(state, what, self._made(state) if spelled else None)

    def _made(self, state: State) -> Held | None:
        """What the statement at hand makes, which Python raises behind it."""
        at = self._frame.at
        if not self._frame.python:
            return None
        return Held("caught", "", self._frame.body[at].value, self._frame.place(state), at)

    def raised(self, state: State, what: Kind | Raising | None, made: Held | None = None) -> None:
        """Note a state in which something surely raises: it goes on in the first handler that is for it."""
        made = Held("caught", "", None, what.env) if isinstance(what, Raising) else made
        passing: State | None = state
        for around in reversed(self._around):
            if not around.handlers:
                around.passing.append(Raised(state, what, made))
                return
            for handler in around.handlers:
                passing = self._past(handler, Raised(passing, what, made)) if passing is not None else None
            if passing is None:
                return
            state = passing
        if not self._frame.later:
            self._frame.run.raised.append(Raised(state, what, made))

    def may_raise(self, state: State) -> None:
        """Note a state in which something may raise, nobody knows what: any handler around may go on."""
        for around in reversed(self._around):
            if not around.handlers:
                around.risky.append(state)
                return
            for handler in around.handlers:
                handler.caught.append(Raised(state, None))
            if any(not handler.types for handler in around.handlers):
                return
        self._frame.run.risky = True

    def _past(self, handler: Catching, raised: Raised) -> State | None:
        """The state in which a handler is passed by, which gets what it is for."""
        if isinstance(raised.what, Raising) and handler.types:
            return self._past_by_statement(handler, raised, raised.what)
        fits = not handler.types or self._fits(raised.what, handler.types)
        if fits is not False:
            handler.caught.append(raised)
        return None if fits else raised.state

    def _past_by_statement(self, handler: Catching, raised: Raised, raising: Raising) -> State | None:
        fitting = Fitting(raising, handler.types)
        holds = self._frame.judge.decided(fitting).holds if self._frame.rounds else None
        if holds is not False:
            handler.caught.append(raised._replace(state=raised.state.through(fitting, True)))
        return None if holds else raised.state.through(fitting, False)

    def _fits(self, what: Kind | Raising | None, types: Sequence[Kind | None]) -> bool | None:
        return any_fits([what], types) if isinstance(what, Kind) else None

    def enter_attempt(self, types: Sequence[tuple[Kind | None, ...]]) -> None:
        """From here on, what is raised goes to handlers, each for some types."""
        self._around.append(Around(tuple([Catching(each) for each in types])))

    def enter_final(self) -> None:
        """From here on, what is raised passes by what runs in the end."""
        self._around.append(Around())

    def end(self) -> Around:
        """Return what was raised within the innermost handlers, or came by what runs in the end."""
        return self._around.pop()

    @contextmanager
    def handling(self, caught: Sequence[Raised]) -> Iterator[None]:
        """Within it, what is handled may be raised again."""
        kinds = {each.what for each in caught}
        self._handling.append(kinds.pop() if len(kinds) == 1 else None)
        yield
        self._handling.pop()

    # --- the function ------------------------------------------------------------------------------------

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

    # --- loops and switches ------------------------------------------------------------------------------

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

    # --- code of its own ---------------------------------------------------------------------------------

    @contextmanager
    def within_lambda(self) -> Iterator[None]:
        """Within it, loops and handlers around mean nothing."""
        keep = (self._breaks, self._continues, self._around, self._handling)
        self._breaks, self._continues, self._around, self._handling = [[]], [[]], [], []
        yield
        self._breaks, self._continues, self._around, self._handling = keep

    @contextmanager
    def unreached(self) -> Iterator[None]:
        """Within it, no way out leads anywhere."""
        run = self._frame.run
        left, returns, raised, risky = self.left, run.returns, run.raised, run.risky
        self.left, run.returns, run.raised = [], [], []
        with self.within_lambda():
            yield
        self.left, run.returns, run.raised, run.risky = left, returns, raised, risky
