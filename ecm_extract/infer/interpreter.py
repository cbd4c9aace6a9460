"""Runs a function abstractly: every statement with the states in which it is reached.

Both sides of a branch run and their states join; which of them is taken is decided when somebody wants to know (see
`routes`), and at once in the rounds of a loop. Loops over what is known are unrolled, others run once with what their
body changes unknown. What is not modelled makes a value unknown, never stale.
"""

from __future__ import annotations

from collections.abc import Set
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Attempt, Block, Branch, Later, Leave, Loop, Step, Switch, statements

from ecm_extract.infer.assigning import Assigning
from ecm_extract.infer.branching import Branching
from ecm_extract.infer.calling import Calling
from ecm_extract.infer.choosing import Choosing
from ecm_extract.infer.comprehending import Comprehending
from ecm_extract.infer.directives import declared_beyond
from ecm_extract.infer.exits import Exits
from ecm_extract.infer.giving import Giving
from ecm_extract.infer.held import Held, State, either, joined_states
from ecm_extract.infer.judge import Judge
from ecm_extract.infer.looping import Looping
from ecm_extract.infer.memory import Memory
from ecm_extract.infer.places import is_kept_value
from ecm_extract.infer.raising import asks_what_raises
from ecm_extract.infer.raising_statements import RaisingStatements
from ecm_extract.infer.read_into import ReadInto
from ecm_extract.infer.routes import NOWHERE
from ecm_extract.infer.run import Frame, Run
from ecm_extract.link.code.walk import perhaps_called

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Env

MAX_NESTING = 60
"""Blocks within blocks that are followed; what is deeper changes its variables in ways that nobody knows."""


class Interpreter:
    """One run of one function; the arguments are those of `Frame`."""

    def __init__(self, env: Env, judge: Judge, whole: bool = True) -> None:
        self.frame = Frame(env, judge, whole)
        self.exits = Exits(self.frame)
        self.memory = Memory(self.frame)
        self.assigning = Assigning(self.frame, self.memory)
        self.giving = Giving(self.frame, self.memory)
        self.calling = Calling(self.frame, self.memory, self.giving)
        self.raising = RaisingStatements(self.frame, self.exits, self.memory)
        self.branching = Branching(self.frame, self.exits, self)
        self.choosing = Choosing(self.frame, self.calling, self.branching)
        self.comprehending = Comprehending(self.frame, self.assigning, self.choosing)
        self.looping = Looping(self.frame, self.exits, self.assigning, self.comprehending, self)
        self._nesting = 0

    def result(self) -> Run:
        """Run the function from its beginning."""
        run = self.frame.run
        begun = self.frame.env.state or State()
        end = self.run(self.frame.outline.block, self.memory.lost(begun, self.frame.outline.unfollowed))
        run.end, run.steps = joined_states([*self.exits.left, end]), self.frame.steps
        self.memory.sharing.consisting.forget()
        return run

    # --- blocks ------------------------------------------------------------------------------------------

    def run(self, block: Block, state: State | None) -> State | None:
        """Run steps in order; None when no way leads out of their end."""
        if self._nesting >= MAX_NESTING:
            self.frame.run.cut = True
            return self._cut(block, state) if state is not None else None
        self._nesting += 1
        before = state
        for at, step in enumerate(block):
            after = self._step(step, state) if state is not None else None
            if after is None:
                self.unreached(block[at + 1 :], state)
                state = None
                break
            state = after
        self._nesting -= 1
        return self._outside_again(block, before, state)

    def _cut(self, block: Block, state: State) -> State:
        """The state after steps that are not followed, which may raise as well."""
        after = self.memory.lost(state, self.memory.changed_in(block))
        self.exits.may_raise(after)
        return after

    def unreached(self, block: Block, state: State | None) -> None:
        """Follow code that no run reaches, so that what it would do is known too."""
        first = next(statements(block), -1)
        if state is None or first < 0 or first in self.frame.run.states:
            return
        self.frame.blurred += 1
        with self.exits.unreached():
            self.run(block, replace(state, route=NOWHERE))
        self.frame.blurred -= 1

    def _outside_again(self, block: Block, before: State | None, state: State | None) -> State | None:
        """In C++ a variable of a block hides one of the same name around it, until the block ends."""
        if self.frame.python or self._nesting == 0 or before is None or state is None:
            return state
        places = [step.each if isinstance(step, Loop) else step for step in block]
        own = (step for step in places if isinstance(step, int) and step >= 0 and step not in self._beyond)
        steps = (self.frame.body[step] for step in own)
        lets = (entry for entry in steps if entry.kind in {"let", "each"})
        bound = {key for entry in lets for key in self.frame.outline.bound_keys(entry.target)}
        for key in (key for key in bound if not is_kept_value(key)):
            state = self.memory.again(key, before, state)
        return state

    @cached_property
    def _beyond(self) -> Set[int]:
        return frozenset(declared_beyond(self.frame.outline.block))

    def _step(self, step: Step, state: State) -> State | None:
        if isinstance(step, int):
            return self._statement(step, state)
        asks = self.exits.catches or not self.frame.run.risky
        raises = asks and asks_what_raises(step, self.frame.body, self.frame.language)
        after = self._taken(step, self._raising(raises, state))
        return after if after is None or not isinstance(step, Loop) else self._raising(raises, after)

    def _raising(self, raises: bool, state: State) -> State:
        """The same state, with which handlers around go on where something raises."""
        if raises:
            self.exits.may_raise(state)
        return state

    def _taken(self, step: Step, state: State) -> State | None:
        if isinstance(step, Branch):
            return self.branching.branch(step, state)
        if isinstance(step, Loop):
            return self.looping.run(step, state)
        if isinstance(step, Switch):
            return self.branching.switch(step, state)
        if isinstance(step, Attempt):
            return self.branching.attempt(step, state)
        if isinstance(step, Later):
            return self._run_later(step, state)
        if isinstance(step, Leave) and step.how == "goto":
            return state  # where it leads is not followed (see `Outline.unfollowed`)
        if isinstance(step, Leave) and step.how == "throw":
            self.exits.thrown(state, step.raised)
        elif isinstance(step, Leave):
            self.exits.leave(step.how, state)
        return None

    def _run_later(self, step: Later, state: State) -> State:
        """A lambda may run any time from now on: what it assigns, and what is assigned after it, is unknown to it."""
        own = (self.memory.declared_in(step.body) | set(step.params)) - {""}  # a parameter may have no name
        changed = self.memory.changed_in(step.body)
        inside = (changed | self.memory.sharing.with_shared(self.calling.changed_later(step.body))) - own
        self.memory.escaped |= inside
        for key in filter(self.memory.is_open, inside):
            self.frame.run.shown[key] += state.holds.get(key, ())  # as long as it does not run
        again = {key for key in state.holds if self.frame.outline.changes.get(key, 0) > 1}
        shared = {key: (Held("shared", key),) for key in again | inside if self.memory.is_open(key)}
        start = self.memory.lost(self.memory.reached(inside, state), again | own).having(shared)
        self.frame.later += 1
        with self.exits.within_lambda():
            self.run(step.body, self.frame.undecided(start))
        self.frame.later -= 1
        return self.memory.reached(inside, state).having({key: ways for key, ways in shared.items() if key in inside})

    # --- statements --------------------------------------------------------------------------------------

    def _statement(self, at: int, state: State) -> State | None:
        self.frame.steps += 1
        self.frame.at = at
        statement = self.frame.body[at]
        if statement.kind == "each":
            self.comprehending.begin(at)
            self.frame.record(at, [state])
            return self.calling.any_times(at, state)  # a loop of a comprehension, or one within that
        called = self.comprehending.after(statement, at, state)
        if statement.kind == "do" and statement.type.startswith("yield"):
            self.frame.run.yields.append((at, state))
        env = self.frame.place(state)
        after = self._read(at, env, called)
        passed = self.raising.past(at, env, state, after)
        if passed is None:
            return None
        if statement.kind == "return":
            self.exits.returned(at, self.calling.undone(at, state, passed), passed)
            return None
        return self._given(statement, at, env, passed)

    def _read(self, at: int, env: Env, state: State) -> State:
        """The state after a statement has read parameters into variables."""
        for read in self.frame.outline.reads.get(at, ()):
            key = self.frame.effects.key(read.out)
            if key:
                before = state.holds.get(key, ())
                held = Held("read", key, read.name, env, at, read.default, before)
                state = self.memory.hold(key, held, state)
                if read.default is not None and self._is_perhaps(read, at):
                    state = state.having({key: either(key, before or (Held("given", key),), state.holds[key])})
        return state

    def _is_perhaps(self, read: ReadInto, at: int) -> bool:
        """Whether a parameter is read on one side of a choice only: `known && nh.param("x", x, 1)`."""
        return any({read.name, read.out} <= set(call.args) for call in perhaps_called(self.frame.body[at].value))

    def _given(self, statement: Statement, at: int, env: Env, state: State) -> State:
        """The state after a statement has given its target a value, and others ways to variables."""
        sees = self.giving.note(statement, at, env, state)
        if statement.kind == "do":
            return state
        state = self.memory.lost(state, self.assigning.escape(statement))
        state = self.assigning.assign(statement, at, env, self.assigning.shared_change(statement, state))
        if sees:
            return self.memory.lost(state, self.frame.outline.bound_keys(statement.target))
        return self.giving.written(statement.target, state) if statement.kind == "set" else state
