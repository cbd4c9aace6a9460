"""Nesting of CMake commands: conditions, loops, functions and macros as a tree."""

from __future__ import annotations

from typing import TypeAlias

import msgspec

from ecm_parsers.cmake_tokens import Argument, Command
from ecm_parsers.result import Diagnostic

MAX_DEPTH = 40
_OPENERS = frozenset({"if", "foreach", "while", "function", "macro", "block"})
_CLOSERS = frozenset({f"end{name}" for name in _OPENERS})
_BRANCHES = frozenset({"elseif", "else"})


class Branch(msgspec.Struct, frozen=True):
    """The header and body of one arm of a block; only conditions have more than one arm."""

    header: tuple[Argument, ...]
    body: tuple[Step, ...]


class Block(msgspec.Struct, frozen=True):
    """`if`, `foreach`, `while`, `function`, `macro` or `block` with what is in it."""

    kind: str
    branches: tuple[Branch, ...]
    line: int


Step: TypeAlias = Command | Block


class _Open(msgspec.Struct):
    """A block whose end was not seen yet."""

    kind: str
    header: tuple[Argument, ...]
    line: int
    body: list[Step]
    branches: list[Branch]


def nest(commands: tuple[Command, ...], diagnostics: list[Diagnostic]) -> tuple[Step, ...]:
    """Return the commands as a tree; blocks that are never closed end with the file."""
    stack = [_Open("file", (), 0, [], [])]
    for command in commands:
        if command.name in _OPENERS:
            if len(stack) >= MAX_DEPTH:
                message = f"Blocks nested deeper than {MAX_DEPTH}; the rest is not read."
                diagnostics.append(Diagnostic("error", "cmake-too-deep", command.line, message, cut=True))
                break
            stack.append(_Open(command.name, command.args, command.line, [], []))
        elif command.name in _CLOSERS:
            _close(stack, command, diagnostics)
        elif command.name in _BRANCHES and stack[-1].kind == "if":
            _next_branch(stack[-1], command)
        else:
            stack[-1].body.append(command)
    while len(stack) > 1:
        _finish(stack)
    return tuple(stack[0].body)


def _close(stack: list[_Open], command: Command, diagnostics: list[Diagnostic]) -> None:
    """End the innermost block if it is of the kind that `command` ends."""
    if stack[-1].kind == command.name.removeprefix("end"):
        _finish(stack)
    else:
        message = f"'{command.name}' closes nothing here; check the blocks above."
        diagnostics.append(Diagnostic("warning", "cmake-unbalanced", command.line, message))


def _finish(stack: list[_Open]) -> None:
    block = stack.pop()
    block.branches.append(Branch(block.header, tuple(block.body)))
    stack[-1].body.append(Block(block.kind, tuple(block.branches), block.line))


def _next_branch(block: _Open, command: Command) -> None:
    block.branches.append(Branch(block.header, tuple(block.body)))
    block.header = command.args if command.name == "elseif" else ()  # `else(WIN32)` repeats the condition for people
    block.body = []
