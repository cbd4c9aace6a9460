"""Steps of which one way is taken: branches, switches, attempts with handlers."""

from __future__ import annotations

from typing import Protocol

from ecm_parsers.source.expr import Constant, Expr, Op
from ecm_parsers.source.flow import Attempt, Block, Branch, Case, Leave, Switch, blocks

from ecm_extract.infer.exits import Around, Exits
from ecm_extract.infer.held import State, joined_states
from ecm_extract.infer.routes import OPEN
from ecm_extract.infer.run import Frame


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
        gate = self.frame.gate(step.test, state)
        if gate is not None and self.frame.rounds:  # whether a loop goes on must be known now
            found = self.frame.judge.decided(gate)
            if found.holds is not None:
                self.blocks.unreached(step.other if found.holds else step.then, state)
                return self.blocks.run(step.then if found.holds else step.other, state)
            gate = None if found == OPEN else gate
        then = self.blocks.run(step.then, state.on(self.frame.side(step.test, True, state, gate)))
        other = self.blocks.run(step.other, state.on(self.frame.side(step.test, False, state, gate)))
        return _behind(step, state, joined_states([then, other]))

    def switch(self, step: Switch, state: State) -> State | None:
        """Run the cases that may apply."""
        return _behind(step, state, self._falling(step, state) if step.falls else self._chosen(step, state))

    def _chosen(self, step: Switch, state: State) -> State | None:
        """The first case that applies runs."""
        rest: State | None = state
        outs: list[State | None] = []
        for case in step.cases:
            holds = self._applies(step.subject, case, state) if rest is not None else False
            if holds is False or rest is None:
                self.blocks.unreached(case.body, state)
            elif holds:
                outs.append(self.blocks.run(case.body, rest))
                rest = None
            else:
                asked = _question(step.subject, case)
                outs.append(self.blocks.run(case.body, rest.on(self.frame.side(asked, True, rest))))
                rest = rest.on(self.frame.side(asked, False, rest))
        return joined_states([*outs, rest])

    def _applies(self, subject: Expr, case: Case, state: State) -> bool | None:
        if not case.tests or not self.frame.whole:
            return None if case.tests else True
        env = self.frame.place(state)
        if subject == Constant("true"):
            return self.frame.judge.truth(case.tests[0], env)
        found = [self.frame.judge.alike(subject, test, env) for test in case.tests]
        return True if True in found else None if None in found else False

    def _falling(self, step: Switch, state: State) -> State | None:
        """From the case that applies on until something leaves."""
        entries = self._entries(step, state)
        self.exits.enter_switch()
        current: State | None = None
        for case, entry in zip(step.cases, entries, strict=True):
            asked = _question(step.subject, case)
            given = state if entry else state.on(self.frame.side(asked, True, state)) if entry is None else None
            current = joined_states([current, given])
            if current is None:
                self.blocks.unreached(case.body, state)
            else:
                current = self.blocks.run(case.body, current)
        passed = state if not any(entries) and all(case.tests for case in step.cases) else None
        return joined_states([*self.exits.end_switch(), current, passed])

    def _entries(self, step: Switch, state: State) -> list[bool | None]:
        """Whether a run enters each case: the first that surely applies, those before it that may, else the default."""
        found: list[bool | None] = []
        for case in step.cases:
            settled = True in found
            found.append(False if settled or not case.tests else self._applies(step.subject, case, state))
        default = False if True in found else None if None in found else True
        return [default if not case.tests else entry for case, entry in zip(step.cases, found, strict=True)]

    def attempt(self, step: Attempt, state: State) -> State | None:
        """Run a block, its handlers where something in it may raise, and what runs in the end."""
        if not step.final:
            return self._handled(step, state)
        self.exits.enter_final()
        met = self._handled(step, state)
        around = self.exits.end()
        if met is None and not around.passing and not around.risky:
            self.blocks.unreached(step.final, state)
        self._pass_by(step.final, around)
        return self.blocks.run(step.final, met)

    def _handled(self, step: Attempt, state: State) -> State | None:
        kind, func = self.frame.judge.exceptions.kind, self.frame.env.func
        self.exits.enter_attempt([tuple([kind(name, func) for name in each.types]) for each in step.handlers])
        done = self.blocks.run(step.body, state)
        around = self.exits.end()
        outs = [self.blocks.run(step.other, done)]
        for handler, catching in zip(step.handlers, around.handlers, strict=True):
            caught = joined_states([each.state for each in catching.caught])
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
    if subject == Constant("true"):
        return case.tests[0]
    asked = [Op("==", (subject, test)) for test in case.tests]
    return asked[0] if len(asked) == 1 else Op("||", tuple(asked)) if asked else None
