"""What a run of a function leaves behind, and the function while it is run."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from ecm_parsers.source.expr import Expr
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.effects import Effects
from ecm_extract.infer.held import Held, State, Turn, joined_states
from ecm_extract.infer.judge import Judge
from ecm_extract.infer.kinds import Kind
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.routes import Gate, Raising

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Env

MAX_STATES = 256
"""States of one statement that are kept apart; beyond, they are joined."""
MAX_ITEMS = 256
"""Elements that a loop over what is known takes one by one."""
MAX_ROUNDS = 64
"""Rounds of a loop by its condition that are run one by one: most count something that nobody declares."""
MAX_STEPS = 4_000
"""Statements that one run may take; beyond, loops are no longer unrolled."""


class Raised(NamedTuple):
    """A state in which something raises, and what: by type, or by the statement; None where that is not known.

    `made` is the exception, as a variable holds it; None where nothing tells how it was made.
    """

    state: State
    what: Kind | Raising | None
    made: Held | None = None


@dataclass(slots=True, eq=False)
class Run:
    """What a function does for one binding of its parameters.

    Attributes:
        states: statement -> the states in which it is reached, if their routes are taken.
        returns: the `return` statements with their states.
        yields: the statements that yield something with their states, in order.
        end: the state in which the function is left; None when it never is.
        shown: member or variable outside of functions -> what it holds while other functions may run.
        cut: whether a bound was hit.
        raised: the states in which it is surely left by an exception, if their routes are taken.
        risky: whether anything else in it may raise that nobody in it handles.
        steps: how many statements were taken.
    """

    states: dict[int, list[State]] = field(default_factory=lambda: defaultdict(list))
    returns: list[tuple[int, State]] = field(default_factory=list)
    yields: list[tuple[int, State]] = field(default_factory=list)
    end: State | None = None
    shown: dict[str, list[Held]] = field(default_factory=lambda: defaultdict(list))
    cut: bool = False
    raised: list[Raised] = field(default_factory=list)
    risky: bool = False
    steps: int = 0


class Frame:
    """One function while it is run: what is known of it, where the run is, and how closely it is followed.

    Args:
        env: the place of evaluation at the entry: function, arguments, object.
        judge: who evaluates expressions.
        whole: whether conditions are decided and loops unrolled; else every way is taken for possible, which is quick.

    Attributes:
        at: the statement at hand. steps: statements taken so far.
        blurred: loops around, of which one round stands for all. later: functions around, which run any time later.
        rounds: loops around that are run round by round.
    """

    def __init__(self, env: Env, judge: Judge, whole: bool) -> None:
        self.env = env
        self.judge = judge
        self.whole = whole
        self.outline: Outline = judge.outline(env.func)
        self.effects: Effects = self.outline.effects
        self.language = env.func.file.language
        self.python = self.language == "python"
        self.body: Sequence[Statement] = env.func.fact.body
        self.run = Run()
        self.at = 0
        self.steps = 0
        self.blurred = 0
        self.later = 0
        self.rounds = 0

    @property
    def follows(self) -> bool:
        """Whether loops over what is known are run round by round, those within a round that stands for all too."""
        return self.whole and self.steps <= MAX_STEPS

    @property
    def unrolls(self) -> bool:
        """Whether loops that ask a condition are run round by round."""
        return self.follows and not self.blurred

    def place(self, state: State) -> Env:
        """Return the place of the statement at hand, in a state."""
        return self.env.within(state, self.at)

    def truth(self, test: Expr, state: State) -> bool | None:
        """Tell whether a condition holds in a state; None when that is not decided."""
        return self.judge.truth(test, self.place(state)) if self.whole else None

    def gate(self, test: Expr, state: State) -> Gate | None:
        """Return what a branch asks in a state; None where nothing is decided."""
        return Gate(test, self.place(state)) if self.whole else None

    def side(self, test: Expr | None, holds: bool, state: State, gate: Gate | None = None) -> Turn:
        """Return one side of a branch, by what is asked there."""
        return Turn(test, holds, self.place(state), gate=gate)

    def undecided(self, state: State) -> State:
        """Return a state beyond a branch that nobody can decide."""
        return state.on(Turn())

    def record(self, at: int, states: Iterable[State]) -> None:
        """Note the states in which a statement is reached."""
        known = self.run.states[at]
        for state in states:
            if len(known) < MAX_STATES:
                known.append(state)
            else:
                met = joined_states([known[-1], state])
                known[-1] = met.along((*met.path, Turn())) if met is not None else state
                self.run.cut = True
