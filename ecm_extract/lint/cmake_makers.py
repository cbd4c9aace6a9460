"""Builds whose programs and libraries no target of their CMake files names."""

from __future__ import annotations

import re
from typing import Final

from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

_DEFINED: Final = re.compile(rb"\b(?:macro|function)\s*\(\s*(\w+)(.*?)\bend(?:macro|function)\s*\(", re.DOTALL | re.I)
_BUILDS: Final = re.compile(rb"add_executable\s*\(", re.I)
_CALLED: Final = re.compile(rb"^[ \t]*(\w+)\s*\(\s*\)", re.MULTILINE)
"""Without arguments, so that no name of a program is given."""


def makers(workspace: Workspace) -> frozenset[bytes]:
    """Return the commands that files of the workspace define with an `add_executable` inside, in lower case."""
    modules = [entry.path for entry in workspace.tree.files() if entry.path.endswith(".cmake")]
    return frozenset(
        name.lower()
        for path in modules
        for name, body in _DEFINED.findall(workspace.files.read(path) or b"")
        if _BUILDS.search(body)
    )


def asks(package: PackageFacts, commands: frozenset[bytes], workspace: Workspace) -> bool:
    """Tell whether a build file of a package calls one of the commands without naming a program."""
    return bool(commands) and any(
        name.lower() in commands
        for path in package.cmake
        for name in _CALLED.findall(workspace.files.read(path) or b"")
    )


def brings_targets(package: PackageFacts) -> bool:
    """Tell whether what CMake downloads, or files that are not read, may make targets of a package."""
    return any(file.unknown for file in package.cmake.values())
