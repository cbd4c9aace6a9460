"""What a build uses of packages that no file of the package names which asks for them."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import msgspec

from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts
from ecm_extract.shipped import shipped_as

_DEFINING = frozenset({"function", "macro"})
_CMAKE = ".cmake"


class ToolRow(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Packages that any build may use; the head of the table says what each column means."""

    source: str
    names: frozenset[str]


class GeneratedRow(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Packages that the code includes which is generated of a kind of interface."""

    of: str
    ros: int
    source: str
    names: frozenset[str]


class BuildTools(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The whole table."""

    tool: tuple[ToolRow, ...]
    generated: tuple[GeneratedRow, ...]


@cache
def build_tools() -> BuildTools:
    """Return the table."""
    return shipped_as("lint/build_tools.toml", BuildTools)


def is_build_tool(package: str) -> bool:
    """Tell whether a build may use a package without a word of it."""
    return any(package in row.names for row in build_tools().tool)


def used_by_generated(package: PackageFacts) -> frozenset[str]:
    """Return the packages that code includes which is generated of the interfaces of a package."""
    shapes = {definition.shape for definition in package.interfaces.values()}
    rows = (row for row in build_tools().generated if row.of in shapes and package.ros in {row.ros, None})
    return frozenset(name for row in rows for name in row.names)


def is_for_cmake(path: str) -> bool:
    """Tell whether a file is code of CMake that others include, or becomes it when it is filled in."""
    return _CMAKE in path.rpartition("/")[2]


def calls_of(package: PackageFacts, workspace: Workspace) -> frozenset[str]:
    """Return the commands that the build of a package calls."""
    return frozenset(command.name for path in package.cmake for command in workspace.commands(path))


def defined_for_cmake(package: PackageFacts, workspace: Workspace) -> Iterator[str]:
    """Yield the commands that a package defines for the builds of others."""
    for entry in package.root.files:
        for command in workspace.commands(entry.path) if is_for_cmake(entry.path) else ():
            if command.name in _DEFINING and command.args:
                yield command.args[0].text.lower()
