"""Steps of which one way is taken: branches, switches, attempts with handlers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import NamedTuple, Protocol

from ecm_parsers.source.expr import Constant, Expr, Op
from ecm_parsers.source.flow import Attempt, Block, Branch, Case, Handler, Leave, Switch, blocks

from ecm_extract.infer.exits import Around, Exits
from ecm_extract.infer.held import Held, State, joined_states
from ecm_extract.infer.narrowing import narrowings
from ecm_extract.infer.read_outcomes import read_outcomes
from ecm_extract.infer.routes import OPEN
from ecm_extract.infer.run import Frame, Raised


class Sides(NamedTuple):
    """The states on both sides of what is asked; None for a side that is not taken."""

    taken: State | None
    passed: State | None


class Blocks(Protocol):
    """Who runs blocks."""

    def run(self, block: Block, state: State | None) -> State | None:
        """Run steps in order; None when no way leads out of their end."""

    def unreached(self, block: Block, state: State | None) -> None:
        """Follow code that no run reaches, so that what it would do is known too."""


class Branching:
    """Runs the ways that are possible, and joins the states in which they end."""

    def __init__(self, frame: Frame, exits: Exits, blocks: Blocks) -> None:
        self.frame = frame
        self.exits = exits
        self.blocks = blocks

    def branch(self, step: Branch, state: State) -> State | None:
        """Run both sides of a branch; which of them is taken is decided when somebody wants to know."""
        sides = self.sides(step.test, state)
        then = self._side(step.then, sides.taken, state)
        return _behind(step, state, joined_states([then, self._side(step.other, sides.passed, state)]))

    def sides(self, test: Expr, state: State) -> Sides:
        """Return the states on both sides of what a branch asks."""
        gate = self.frame.gate(test, state)
        if gate is not None and self.frame.rounds:  # whether a loop goes on must be known now
            found = self.frame.judge.decided(gate)
            if found.holds is not None:
                return Sides(state, None) if found.holds else Sides(None, state)
            gate = None if found == OPEN else gate
        told = narrowings(self.frame, test, state)
        taken, passed = (
            state.on(self.frame.side(test, holds, state, gate))
            .having({name: each.on(holds) for name, each in told.items()})
            .having(read_outcomes(self.frame, test, state, holds))
            for holds in (True, False)
        )
        return Sides(taken, passed)

    def _side(self, block: Block, taken: State | None, before: State) -> State | None:
        if taken is None:
            self.blocks.unreached(block, before)
            return None
        return self.blocks.run(block, taken)

    def switch(self, step: Switch, state: State) -> State | None:
        """Run the cases that may apply."""
        return _behind(step, state, self._falling(step, state) if step.falls else self._chosen(step, state))

    def _chosen(self, step: Switch, state: State) -> State | None:
        """The first case that applies runs."""
        rest: State | None = state
        outs: list[State | None] = []
        for case in step.cases:
            asked = _question(step.subject, case)
            sides = self.sides(asked, rest) if rest is not None and asked is not None else Sides(rest, None)
            outs.append(self._side(case.body, sides.taken, state))
            rest = sides.passed
        for out in reversed(outs):  # the last two sides meet first
            rest = joined_states([out, rest])
        return rest

    def _falling(self, step: Switch, state: State) -> State | None:
        """From the case that applies on until something leaves."""
        entries, rest = self._entries(step, state)
        self.exits.enter_switch()
        current: State | None = None
        for case, entry in zip(step.cases, entries, strict=True):
            current = self._side(case.body, joined_states([current, entry]), state)
        met = joined_states([current, rest])
        for out in reversed(self.exits.end_switch()):
            met = joined_states([out, met])
        return met

    def _entries(self, step: Switch, state: State) -> tuple[list[State | None], State | None]:
        """Return the state in which a run enters each case, of which one applies, and the one in which none does."""
        rest: State | None = state
        found: list[State | None] = []
        for case in step.cases:
            asked = _question(step.subject, case)
            sides = self.sides(asked, rest) if rest is not None and asked is not None else Sides(None, rest)
            found.append(sides.taken)
            rest = sides.passed.along(state.path) if sides.passed is not None else None
        if all(case.tests for case in step.cases):
            return found, rest
        default = self._otherwise(step, rest, state) if rest is not None and any(found) else rest
        return [entry if case.tests else default for case, entry in zip(step.cases, found, strict=True)], None

    def _otherwise(self, step: Switch, rest: State, before: State) -> State:
        """The state in which a run enters the default: what none of the cases asks holds, and is no condition."""
        asked = [each for case in step.cases if (each := _question(step.subject, case)) is not None]
        gate = self.frame.gate(Op("!", (_any_of(asked),)), before)
        return rest.along((*rest.path, self.frame.side(None, True, before, gate)))

    def attempt(self, step: Attempt, state: State) -> State | None:
        """Run a block, its handlers where something in it may raise, and what runs in the end."""
        if not step.final:
            return self._handled(step, state)
        before = self.exits.reached()
        self.exits.enter_final()
        met = self._handled(step, state)
        around = self.exits.end()
        self.exits.leave_through(before, lambda leaving: self.blocks.run(step.final, leaving))
        if met is None and not around.passing and not around.risky:
            self.blocks.unreached(step.final, state)
        self._pass_by(step.final, around)
        return self.blocks.run(step.final, met)

    def _handled(self, step: Attempt, state: State) -> State | None:
        if not step.handlers:
            return self.blocks.run(step.body, state)
        kind, func = self.frame.judge.exceptions.kind, self.frame.env.func
        self.exits.enter_attempt([tuple([kind(name, func) for name in each.types]) for each in step.handlers])
        done = self.blocks.run(step.body, state)
        around = self.exits.end()
        outs = [self.blocks.run(step.other, done)]
        for handler, catching in zip(step.handlers, around.handlers, strict=True):
            caught = joined_states([_with_exception(handler, each) for each in catching.caught])
            if caught is None:
                self.blocks.unreached(handler.body, state)
                continue
            with self.exits.handling(catching.caught):
                outs.append(self.blocks.run(handler.body, self.frame.undecided(caught)))
        return joined_states(outs)

    def _pass_by(self, final: Block, around: Around) -> None:
        """What is raised goes on behind what runs in the end."""
        kinds = {each.what for each in around.passing}
        surely = joined_states([each.state for each in around.passing])
        if surely is not None:
            after = self.blocks.run(final, self.frame.undecided(surely))
            if after is not None:
                self.exits.raised(after, kinds.pop() if len(kinds) == 1 else None)
        maybe = joined_states(around.risky)
        if maybe is not None:
            after = self.blocks.run(final, self.frame.undecided(maybe))
            if after is not None:
                self.exits.may_raise(after)


def _with_exception(handler: Handler, raised: Raised) -> State:
    """The state in which a handler begins, where it may have the exception in a variable."""
    if not handler.name:
        return raised.state
    made = replace(raised.made, name=handler.name) if raised.made is not None else Held("lost", handler.name)
    return raised.state.having({handler.name: (made,)})


def _behind(step: Branch | Switch, before: State, after: State | None) -> State | None:
    """The state behind a branch: the sides that it still came through are those that others left."""
    count = len(before.path)
    if after is None or len(after.path) <= count:
        return after
    thrown = any(isinstance(entry, Leave) and entry.how == "throw" for block in blocks(step) for entry in block[-1:])
    past = [turn.past("throw" if thrown else "return") for turn in after.path[count:]]
    return after.along((*before.path, *past))


def _question(subject: Expr, case: Case) -> Expr | None:
    """What a case of a switch asks, as a condition of its own; None for the default, which asks nothing."""
    if not case.tests:
        return None
    if subject == Constant("true"):
        return case.tests[0]
    asked = [Op("==", (subject, test)) for test in case.tests]
    return _any_of(asked)


def _any_of(asked: Sequence[Expr]) -> Expr:
    return asked[0] if len(asked) == 1 else Op("||", tuple(asked))
