"""Builds whose programs and libraries no target of their CMake files names."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.cmake import parse_cmake
from ecm_parsers.cmake_tokens import Command

from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

_DEFINES: Final = frozenset({"macro", "function"})
_BRING: Final = frozenset({"externalproject_add", "fetchcontent_makeavailable", "fetchcontent_populate"})


def makers(workspace: Workspace) -> frozenset[str]:
    """Return the commands that files of the workspace define with an `add_executable` inside, in lower case."""
    modules = (entry.path for entry in workspace.tree.files() if entry.path.endswith(".cmake"))
    parsed = (workspace.files.parsed(path, parse_cmake) for path in modules)
    return frozenset(name for file in parsed if file is not None for name in _making(file.facts.commands))


def _making(commands: tuple[Command, ...]) -> Iterator[str]:
    """Names of the functions and macros around each `add_executable`."""
    name = ""
    for command in commands:
        if command.name in _DEFINES and command.args:
            name = command.args[0].text.lower()
        elif command.name == "add_executable" and name:
            yield name
        elif command.name.removeprefix("end") in _DEFINES:
            name = ""


def asks(package: PackageFacts, commands: frozenset[str]) -> bool:
    """Tell whether a build file of a package calls one of the commands without naming a program."""
    called = (command for file in package.cmake.values() for command in file.commands if not command.args)
    return any(command.name in commands for command in called)


def brings_targets(package: PackageFacts) -> bool:
    """Tell whether what CMake downloads, or files that it includes by a pattern, may make targets of a package."""
    included = (entry.path for file in package.cmake.values() for entry in file.subdirectories)
    return any("*" in path for path in included) or calls_any(package, _BRING)


def calls_any(package: PackageFacts, names: frozenset[str]) -> bool:
    """Tell whether a build file of a package has one of some commands, in any arm."""
    return any(command.name in names for file in package.cmake.values() for command in file.commands)


def words_of(package: PackageFacts) -> Iterator[str]:
    """Yield the arguments of all commands of a package, as written."""
    return (word.text for file in package.cmake.values() for command in file.commands for word in command.args)
