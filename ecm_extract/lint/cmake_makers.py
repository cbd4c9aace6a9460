"""Builds whose programs and libraries no target of their CMake files names."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ecm_parsers.cmake_blocks import Block, Step, nest
from ecm_parsers.cmake_tokens import parse_commands

from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts


def makers(workspace: Workspace) -> frozenset[str]:
    """Return the commands that modules of the workspace define with an `add_executable` inside, in lower case."""
    modules = (entry.path for entry in workspace.tree.files() if entry.path.endswith(".cmake"))
    texts = (workspace.files.read(path) or b"" for path in modules)
    return frozenset(name for text in texts for name in _defined(nest(parse_commands(text).facts, [])))


def _defined(steps: Sequence[Step]) -> Iterator[str]:
    for step in steps:
        if not isinstance(step, Block):
            continue
        header = step.branches[0].header
        if step.kind in {"function", "macro"} and header and _builds(step):
            yield header[0].text.lower()
        for branch in step.branches:
            yield from _defined(branch.body)


def _builds(step: Step) -> bool:
    if isinstance(step, Block):
        return any(_builds(inner) for branch in step.branches for inner in branch.body)
    return step.name == "add_executable"


def asks(package: PackageFacts, commands: frozenset[str]) -> bool:
    """Tell whether a build calls one of the commands without naming a program."""
    ran = (command for file in package.cmake.values() for command in file.commands)
    return any(command.name in commands and not command.args for command in ran)


def brings_targets(package: PackageFacts) -> bool:
    """Tell whether what CMake downloads, or files that are not read, may make targets of a package."""
    return any(file.unknown for file in package.cmake.values())
