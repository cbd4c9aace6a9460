"""How much is evaluated: bounds for one question, for one function and for all, and where they were hit."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from ecm_extract.link.code.units import Func
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.faults import CODE
from ecm_extract.link.running.values import TOO_DEEP, TOO_MANY, Value
from ecm_extract.tree import FileDiagnostic, Unread, printable

MAX_QUESTION: Final = 1_500
"""Evaluations for one name, type or profile; in 65 public repositories one took more (2,989), the next one 419."""
MAX_FUNCTION: Final = 60_000
"""Statements and evaluations in the runs of one function, whatever it is handed: the most that one took in 35 public
repositories is 30,135. One that works on data may take a hundred times as many, which tell no names."""
PER_RUN: Final = 50
"""What a function has beyond those for each run, so that one that everybody calls is not cut off."""
LEAST_RUN: Final = 2_000_000
"""Evaluations that any run has; those 65 repositories took 90,000 together."""
MAX_PER_STATEMENT: Final = 40
"""Evaluations that a run has for each statement of its sources."""
MAX_TOLD: Final = 20
"""Places that are told one by one."""
_VALUES: Final = "values-left-out"
_HINT: Final = "split the function, or give the name as one literal"


class Steps:
    """Counts evaluations. What is evaluated while nothing else is, is a question; what it leads to belongs to it.

    Use as a context around an evaluation that `take` has allowed.

    Args:
        statements: how many the sources have.
    """

    def __init__(self, statements: int) -> None:
        self.depth = 0
        self._left = max(LEAST_RUN, MAX_PER_STATEMENT * statements)
        self._spent = 0
        self._asked: Env | None = None
        self._runs: list[Func] = []
        self._taken: Counter[Func] = Counter()
        self._cut: dict[tuple[str, int], None] = {}
        self._given_up: dict[tuple[str, int], None] = {}
        self._spent_by: dict[Func, None] = {}
        self._ended: Func | None = None
        self._silent = False

    def take(self, env: Env) -> bool:
        """Tell whether one more evaluation may be made; a refusal is remembered with the place of its question."""
        if not self.depth:
            self._spent, self._asked = 0, env
        self._spent += 1
        self._left -= 1
        if self._left < 0 and self._ended is None:
            self._ended = env.func
        if not self._may_run_on():
            return False
        if self._spent <= MAX_QUESTION and self._left >= 0:
            return True
        self._cut[_place(self._asked or env)] = None
        return False

    def leave_out(self, env: Env) -> None:
        """Remember a place whose values are not all computed; within a question it is the place that asked."""
        if not self._silent:
            self._cut[_place(self._asked if self.depth and self._asked is not None else env)] = None

    def give_up(self, env: Env) -> None:
        """Remember a place whose name lies behind more functions, branches or objects than are followed."""
        self._given_up[_place(env)] = None

    def _may_run_on(self) -> bool:
        """Count an evaluation for the function that is run, and tell whether it has one left."""
        if not self._runs:
            return True
        self.count(self._runs[-1], 1)
        return not self.is_spent(self._runs[-1])

    def is_spent(self, func: Func) -> bool:
        """Tell whether the runs of a function took all that it has."""
        return self._taken[func] > MAX_FUNCTION

    def count(self, func: Func, steps: int) -> None:
        """Note what a run of a function took; one that has nothing left is remembered."""
        self._taken[func] += steps
        if self.is_spent(func):
            self._spent_by[func] = None

    def __enter__(self) -> None:
        self.depth += 1

    def __exit__(self, *_: object) -> None:
        self.depth -= 1

    @contextmanager
    def apart(self) -> Iterator[None]:
        """Within it, each evaluation is a question of its own: a run of a function asks many."""
        depth, spent, asked = self.depth, self._spent, self._asked
        self.depth = 0
        try:
            yield
        finally:
            self.depth, self._spent, self._asked = depth, spent, asked

    @contextmanager
    def without_a_word(self) -> Iterator[None]:
        """Within it, values that are left out are not remembered: who asks says so where it tells what it got."""
        before, self._silent = self._silent, True
        try:
            yield
        finally:
            self._silent = before

    @contextmanager
    def within(self, func: Func) -> Iterator[None]:
        """Within it, a function is run, for which each evaluation counts."""
        self._runs.append(func)
        self._taken[func] -= PER_RUN
        try:
            with self.apart():
                yield
        finally:
            self._runs.pop()

    def left_out(self) -> tuple[FileDiagnostic, ...]:
        """Return what is to be told of functions that were not run to the end, and of places without a value."""
        told = [_told_of(func) for func in self._spent_by]
        told += [_told_end(self._ended)] if self._ended is not None else []
        told += [_told_depth(path, line) for path, line in self._given_up]
        told += [_told(path, line) for path, line in list(self._cut)[:MAX_TOLD]]
        rest = len(self._cut) - MAX_TOLD
        if rest > 0:
            path, line = list(self._cut)[MAX_TOLD]
            text = f"From here on {rest} more places have values that take too many steps to compute; {_HINT}."
            told.append(FileDiagnostic("warning", _VALUES, path, line, text))
        return tuple(told)


def is_left_out(value: Value) -> bool:
    """Tell whether a value stands for those that are too many."""
    return TOO_MANY.parts[0] in value.parts


def is_too_deep(value: Value) -> bool:
    """Tell whether a bound ended the search for a value, or for a part of it."""
    return TOO_DEEP.parts[0] in value.parts


def _told_of(func: Func) -> FileDiagnostic:
    """A function may make endpoints that are not seen, so it is a gap, where a value is only an open one."""
    path = printable(func.file.path)
    text = (
        f"{printable(func.fact.name)} takes too many steps to be followed to its end: values, and what it declares "
        "with them, may be missing; split it, or keep what is declared out of its loops."
    )
    return FileDiagnostic("warning", CODE, path, func.fact.line, text, Unread(path, "unfollowed"))


def _told_end(func: Func) -> FileDiagnostic:
    """What is asked behind the bound of a run is not computed, so any endpoint may be missing."""
    path = printable(func.file.path)
    text = (
        f"Here, in {printable(func.fact.name)}, this run had taken all steps that it has: values behind it, and what "
        "is declared with them, may be missing; read the packages one by one."
    )
    return FileDiagnostic("warning", CODE, path, func.fact.line, text, Unread(path, "unfollowed"))


def _told(path: str, line: int) -> FileDiagnostic:
    text = f"A value here takes too many steps to compute, so it is unknown; {_HINT}."
    return FileDiagnostic("warning", _VALUES, path, line, text)


def _told_depth(path: str, line: int) -> FileDiagnostic:
    """Nobody knows which endpoint it is, since the search for its name was ended: a gap."""
    text = (
        "The name of an endpoint here lies behind more functions, branches or objects than are followed, so it is "
        f"unknown; {_HINT}."
    )
    return FileDiagnostic("warning", _VALUES, printable(path), line, text, Unread(printable(path), "unfollowed"))


def _place(env: Env) -> tuple[str, int]:
    body = env.func.fact.body
    line = body[env.at].line if env.at < len(body) else env.func.fact.line
    return env.func.file.path, line
