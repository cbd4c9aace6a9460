"""What a run of CMake files is made of: its state, its bounds, and how paths part and meet.

Methods that run steps tell whether their end is reached: a path may leave a body before.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Final, Protocol, TypeVar

import msgspec
from ecm_parsers.cmake_blocks import Block, Step
from ecm_parsers.cmake_tokens import Command
from ecm_parsers.result import Diagnostic

from ecm_extract.cmake.brought import Brought
from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.change import Setter
from ecm_extract.cmake.files import BuildFiles, tree_path
from ecm_extract.cmake.functions import Function
from ecm_extract.cmake.look import Look, Outcomes, worlds
from ecm_extract.cmake.outside import Outside
from ecm_extract.cmake.state import Leave, Path, Snapshot, State, either, meet
from ecm_extract.cmake.values import Value

MAX_CALLS: Final = 20_000
MAX_WORK: Final = 400_000
MAX_DEPTH: Final = 60
Result = TypeVar("Result")


class Unread(msgspec.Struct, frozen=True):
    """What of a build is not known, and where: other targets or sources may come from it."""

    path: str
    line: int
    reason: str


@dataclass
class Evaluation:
    """What running the files of a package gave.

    Attributes:
        files: of the tree.
        calls: in order. paths: of the files that ran.
        diagnostics: by path. unread: what is not known.
    """

    files: BuildFiles
    calls: list[Call] = field(default_factory=list)
    paths: dict[str, None] = field(default_factory=dict)
    diagnostics: dict[str, list[Diagnostic]] = field(default_factory=dict)
    unread: dict[Unread, None] = field(default_factory=dict)


class Place(msgspec.Struct, frozen=True):
    """Where a run stands: the file, the line that called a function (0: not in one), how deep."""

    path: str
    caller_line: int = 0
    depth: int = 0

    def deeper(self) -> Place:
        """Return the place inside a block."""
        return msgspec.structs.replace(self, depth=self.depth + 1)


class Arm(msgspec.Struct, frozen=True):
    """One of the ways on: under which condition, and what runs."""

    condition: str
    by_default: bool | None
    run: Callable[[], bool]
    is_test: bool = False


class Handlers(Protocol):
    """What blocks and commands do to a run."""

    def block(self, run: Run, block: Block, place: Place) -> bool:
        """Run a block."""

    def command(self, run: Run, command: Command, place: Place) -> bool:
        """Run a command."""


@dataclass
class Run:
    """The state of a run.

    Attributes:
        setters: commands that set variables, by name.
        functions: that files of the tree define, by name in lower case.
        targets: names with whether a build without settings of its own has them.
        minimum: version given to `cmake_minimum_required`.
        guarded: files that are not included twice.
    """

    files: BuildFiles
    handlers: Handlers
    setters: dict[str, Setter]
    state: State
    found: Evaluation
    outside: Outside = field(default_factory=Outside)
    brought: Brought = field(default_factory=Brought)
    functions: dict[str, Function] = field(default_factory=dict)
    targets: dict[str, bool | None] = field(default_factory=dict)
    guarded: set[str] = field(default_factory=set)
    minimum: tuple[int, ...] = ()
    work: int = 0
    is_over: bool = False

    def steps(self, steps: Sequence[Step], place: Place) -> bool:
        """Run steps in order."""
        for step in steps:
            if self.is_exhausted(step.line, place):
                return True
            run = self.handlers.block if isinstance(step, Block) else self.handlers.command
            if not run(self, step, place):  # type: ignore[arg-type]  # chosen by the kind of step
                return False
        return True

    def is_exhausted(self, line: int, place: Place) -> bool:
        """Count a step; tell whether a bound is reached, and report it once."""
        self.work += 1
        if not self.is_over and self.work < MAX_WORK and len(self.found.calls) < MAX_CALLS and place.depth < MAX_DEPTH:
            return False
        if not self.is_over:
            message = "Loops or functions expand to too many commands; the rest is not read."
            self.report(place.path, Diagnostic("error", "cmake-too-much-work", line, message))
            self.open(place, line, "too many commands")
        self.is_over = True
        return True

    def report(self, path: str, diagnostic: Diagnostic) -> None:
        """Tell of a problem of a file."""
        self.found.diagnostics.setdefault(path, []).append(diagnostic)

    def open(self, place: Place, line: int, reason: str) -> None:
        """Tell that more may be built than is known."""
        self.found.unread[Unread(place.path, place.caller_line or line, reason)] = None

    # -- variables

    def look(self) -> Look:
        """Return the variables as a build without settings has them."""
        return Look(self.state.variables, {}, self.outside)

    def worlds(self, run: Callable[[Look], Result]) -> Outcomes[Result]:
        """Read variables in each of the ways that they may be."""
        outcomes = worlds(self.state.variables, self.outside, run)
        self.work += len(outcomes.others)
        return outcomes

    def set(self, name: str, text: str) -> None:
        """Set a variable to one text."""
        self.state.assign(name, Value((text,)))

    def folder(self) -> str:
        """Return CMAKE_CURRENT_SOURCE_DIR as a path of the tree."""
        return tree_path(self.look().get("CMAKE_CURRENT_SOURCE_DIR") or "") or ""

    # -- paths

    def branches(self, arms: Sequence[Arm]) -> bool:
        """Run each arm from here, and join what those leave that come to their end."""
        base, path = self.state.snapshot(), self.state.path
        self.work += len(arms) * (1 + len(self.state.variables) // 20)
        before, ends = len(self.state.left), list[Snapshot]()
        for arm in arms:
            self.state.restore(base.scopes)
            self.state.path = path
            self.state.below(arm.condition, arm.by_default, arm.is_test)
            if arm.run():
                ends.append(self.state.snapshot())
        self.state.path = path
        if not ends:
            return False
        self.state.restore(meet(ends, self.outside.may_set))
        if len(self.state.left) > before:
            self.state.path = _of_those_left(path, ends)
        return True

    def bounded(self, kinds: frozenset[Leave], run: Callable[[], bool]) -> bool:
        """Run a body that paths may leave in certain ways, and join them at its end."""
        outer, path = self.state.left, self.state.path
        self.state.left = []
        goes_on = run()
        mine = [each.snapshot for each in self.state.left if each.how in kinds]
        others = [each for each in self.state.left if each.how not in kinds]
        ends = [self.state.snapshot(), *mine] if goes_on and (mine or others) else mine
        self.state.left = [*outer, *others]
        self.state.path = _of_those_left(path, ends) if others and ends else path
        if ends:
            self.state.restore(meet(ends, self.outside.may_set))
        return goes_on or bool(mine)


def _of_those_left(path: Path, ends: Sequence[Snapshot]) -> Path:
    """The path on which those go on that did not leave."""
    by_default: bool | None = False
    for end in ends:
        by_default = either(by_default, end.by_default)
    return msgspec.structs.replace(path, by_default=by_default)
