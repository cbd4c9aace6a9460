"""Straight-line evaluation of a CMake file: which commands run, with which arguments, inside tests or not.

Nothing is executed: conditions on options take all arms, conditions on foreign platforms none.
"""

from __future__ import annotations

import msgspec

from ecm_parsers.cmake_blocks import Block, Branch, Step, nest
from ecm_parsers.cmake_tokens import Argument, Command, parse_commands
from ecm_parsers.cmake_variables import SETTERS, Variables, assign, expand
from ecm_parsers.result import Diagnostic, Parsed

MAX_CALLS = 20_000
MAX_WORK = 400_000
MAX_FUNCTION_CALLS = 1_000
MAX_FUNCTION_DEPTH = 4
_FOREIGN = frozenset({"WIN32", "MSVC", "APPLE", "ANDROID", "CYGWIN", "MINGW", "FALSE", "0", "OFF"})
_TEST_SWITCHES = ("BUILD_TESTING", "CATKIN_ENABLE_TESTING", "BUILD_TESTS", "ENABLE_TESTING", "ENABLE_TESTS")
_LEAVE = frozenset({"return", "break", "continue"})


class Call(msgspec.Struct, frozen=True):
    """A command that runs, with evaluated arguments.

    Attributes:
        name: lower case.
        args: values; what is not known is still a reference `${NAME}`.
        line: 1-based line in the file; for the body of a function or macro the line that calls it.
        is_test: whether it runs only when tests are built.
    """

    name: str
    args: tuple[str, ...]
    line: int
    is_test: bool


class Run(msgspec.Struct, frozen=True):
    """The calls of a file in order, the variables at its end, and its commands as written, of all arms."""

    calls: tuple[Call, ...]
    variables: dict[str, str]
    commands: tuple[Command, ...] = ()


class _Place(msgspec.Struct, frozen=True):
    """Where evaluation stands: in a test block, and called from which line (0: not in a function)."""

    is_test: bool = False
    caller_line: int = 0
    depth: int = 0


def run(data: bytes, variables: Variables) -> Parsed[Run]:
    """Evaluate a file from the variables it inherits; never raises on content."""
    commands = parse_commands(data)
    diagnostics = list(commands.diagnostics)
    runner = _Runner(dict(variables), diagnostics)
    runner.steps(nest(commands.facts, diagnostics), _Place())
    return Parsed(Run(tuple(runner.calls), runner.variables, commands.facts), tuple(diagnostics))


class _Runner:
    """Walks the tree of blocks."""

    def __init__(self, variables: Variables, diagnostics: list[Diagnostic]) -> None:
        self.calls: list[Call] = []
        self.variables = variables
        self._diagnostics = diagnostics
        self._functions: dict[str, tuple[str, Branch]] = {}
        self._function_calls = 0
        self._work = 0

    def steps(self, steps: tuple[Step, ...], place: _Place) -> None:
        """Run steps in order until one leaves the body or the work is bounded."""
        for step in steps:
            if self._exhausted(step.line):
                return
            if isinstance(step, Block):
                self._block(step, place)
            elif step.name in _LEAVE and place.caller_line:
                continue
            else:
                self._command(step, place)

    def _exhausted(self, line: int) -> bool:
        """Count a step; tell (and report once) when the bound is reached."""
        self._work += 1
        if self._work < MAX_WORK and len(self.calls) < MAX_CALLS:
            return False
        if not any(diagnostic.code == "cmake-too-much-work" for diagnostic in self._diagnostics):
            message = "Loops or functions expand to too many commands; the rest is not read."
            self._diagnostics.append(Diagnostic("error", "cmake-too-much-work", line, message))
        return True

    def _block(self, block: Block, place: _Place) -> None:
        if block.kind == "if":
            self._condition(block, place)
        elif block.kind == "foreach":
            self._loop(block.branches[0], place)
        elif block.kind in {"function", "macro"}:
            self._define(block)
        else:
            self.steps(block.branches[0].body, place)

    def _condition(self, block: Block, place: _Place) -> None:
        """Run the arms that can be taken."""
        for branch in block.branches:
            words = _words(branch)
            if _is_false(words):
                continue
            inside = msgspec.structs.replace(place, is_test=place.is_test or _is_test_condition(words))
            self.steps(branch.body, inside)
            if _is_true(words):
                return

    def _loop(self, branch: Branch, place: _Place) -> None:
        """Run a `foreach` body for each value; once with it unknown when the values are not known."""
        if not branch.header:
            return
        name = branch.header[0].text
        before = self.variables.get(name)
        for value in self._loop_values(branch.header[1:]):
            if self._exhausted(branch.header[0].line):
                break
            self.variables.pop(name, None)
            if value is not None:
                assign(name, [value], self.variables)
            self.steps(branch.body, place)
        self.variables.pop(name, None)
        if before is not None:
            self.variables[name] = before

    def _loop_values(self, args: tuple[Argument, ...]) -> list[str | None]:
        """Return the values of a loop; None stands for one that is not known."""
        words = self._expand(args)
        if words[:1] == ["RANGE"]:
            return [None]
        if words[:1] != ["IN"]:
            return [word if word != "${}" else None for word in words]
        values: list[str | None] = []
        mode = ""
        for word in words[1:]:
            if word in {"LISTS", "ITEMS", "ZIP_LISTS"}:
                mode = word
            elif mode == "ITEMS":
                values.append(word)
            elif word in self.variables:
                values.extend(item for item in self.variables[word].split(";") if item)
            else:
                values.append(None)
        return values

    def _define(self, block: Block) -> None:
        branch = block.branches[0]
        if branch.header:
            self._functions[branch.header[0].text.lower()] = (block.kind, branch)

    def _command(self, command: Command, place: _Place) -> None:
        args = self._expand(command.args)
        if command.name in SETTERS:
            SETTERS[command.name](self._setter_args(command), self.variables)
        elif command.name in self._functions and self._may_call(place):
            self._invoke(command, args, place)
        else:
            line = place.caller_line or command.line
            self.calls.append(Call(command.name, tuple(args), line, place.is_test))
            _remember_project(command.name, args, self.variables)

    def _setter_args(self, command: Command) -> list[str]:
        """Return arguments of a command that sets variables, where empty and quoted arguments count."""
        if command.name != "cmake_parse_arguments":
            return self._expand(command.args)
        head = [";".join(expand(argument, self.variables)) for argument in command.args[:4]]
        return head + self._expand(command.args[4:])

    def _expand(self, args: tuple[Argument, ...]) -> list[str]:
        values: list[str] = []
        for argument in args:
            values.extend(expand(argument, self.variables))
        self._work += len(values) // 8
        return values

    def _may_call(self, place: _Place) -> bool:
        self._function_calls += 1
        return self._function_calls <= MAX_FUNCTION_CALLS and place.depth < MAX_FUNCTION_DEPTH

    def _invoke(self, command: Command, args: list[str], place: _Place) -> None:
        """Run the body of a function or macro of this file with its parameters bound."""
        kind, branch = self._functions[command.name]
        outer = self.variables
        self.variables = dict(outer)
        names = [argument.text for argument in branch.header[1:]]
        for position, value in enumerate(args[: len(names)]):
            assign(names[position], [value], self.variables)
        assign("ARGN", args[len(names) :], self.variables)
        assign("ARGV", args, self.variables)
        line = place.caller_line or command.line
        self.steps(branch.body, _Place(place.is_test, line, place.depth + 1))
        if kind == "function":
            self.variables = outer


def _words(branch: Branch) -> list[str]:
    return [argument.text for argument in branch.header if argument.text not in "()"]


def _is_false(words: list[str]) -> bool:
    """Tell whether a condition cannot hold on Linux."""
    if words[:1] == ["NOT"]:
        return len(words) == 2 and words[1] == "UNIX"
    return bool(words) and words[0] in _FOREIGN and "OR" not in words


def _is_true(words: list[str]) -> bool:
    """Tell whether a condition always holds on Linux."""
    if len(words) == 2 and words[0] == "NOT":
        return words[1] in _FOREIGN
    return words in (["UNIX"], ["TRUE"], ["ON"], ["1"])


def _is_test_condition(words: list[str]) -> bool:
    """Tell whether a condition asks for tests to be built."""
    for position, word in enumerate(words):
        negated = position > 0 and words[position - 1] == "NOT"
        if word.strip("${}").upper().endswith(_TEST_SWITCHES) and not negated:
            return True
    return False


def _remember_project(name: str, args: list[str], variables: Variables) -> None:
    """Set the variables that `project()` sets."""
    if name != "project" or not args:
        return
    assign("PROJECT_NAME", [args[0]], variables)
    assign("CMAKE_PROJECT_NAME", [args[0]], variables)
    for directory in ("PROJECT_SOURCE_DIR", "CMAKE_SOURCE_DIR", f"{args[0]}_SOURCE_DIR"):
        assign(directory, ["."], variables)
    if "VERSION" in args[:-1]:
        version = args[args.index("VERSION") + 1]
        assign("PROJECT_VERSION", [version], variables)
        assign(f"{args[0]}_VERSION", [version], variables)
