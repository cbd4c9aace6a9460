"""What a package does with names that others may deprecate, by the facts of its sources, builds and launch files."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import zip_longest
from typing import Any, Literal, NamedTuple, TypeAlias

import msgspec
from ecm_parsers.launch.model import Group, LaunchFile, Node
from ecm_parsers.launch.templates import all_actions, plain_text
from ecm_parsers.source.expr import Call, Expr, Member
from ecm_parsers.source.facts import SourceFile
from ecm_parsers.template import Substitution

from ecm_extract.link.code.walk import expressions
from ecm_extract.lint.workspace import Workspace
from ecm_extract.read.facts import PackageFacts

Way: TypeAlias = Literal["include", "macro", "name", "member", "keyword", "command", "program"]
"""How a name is used; `ecm_extract/lint/deprecations.toml` says what each means."""


class Spoken(NamedTuple):
    """A name that a package uses, and where: a path of the tree and a 1-based line."""

    of: Way
    name: str
    path: str
    line: int


def spoken(package: PackageFacts, workspace: Workspace) -> Iterator[Spoken]:
    """Yield the names that the files of a package use."""
    for path, source in package.sources.items():
        for of, name, line in _of_cpp(source) if source.language == "cpp" else _keywords(source):
            yield Spoken(of, name, path, line)
    for path, build in package.cmake.items():
        yield from (Spoken("command", command.name, path, command.line) for command in build.commands)
    launches = workspace.launches
    for entry in package.root.files:
        if entry.path in launches:
            yield from (Spoken("program", name, entry.path, line) for name, line in _programs(launches[entry.path]))


_Used: TypeAlias = tuple[Way, str, int]


def _of_cpp(source: SourceFile) -> Iterator[_Used]:
    yield from (("include", entry.module, entry.line) for entry in source.imports)
    yield from (("macro", entry.name, entry.line) for entry in source.macros)
    yield from (("name", entry.name, entry.line) for entry in source.mentions)
    yield from (("member", expr.name, line) for expr, line in _expressions(source) if isinstance(expr, Member))


def _keywords(source: SourceFile) -> Iterator[_Used]:
    for expr, _ in _expressions(source):
        if isinstance(expr, Call):
            for (name, _), line in zip(expr.keywords, expr.keyword_lines, strict=False):
                yield "keyword", name, line


def _expressions(source: SourceFile) -> Iterator[tuple[Expr, int]]:
    return (found for function in source.functions for step in function.body for found in expressions(step))


def _programs(launch: LaunchFile) -> Iterator[tuple[str, int]]:
    """The programs that a launch file starts, and those that it runs by their paths: `$(find package)/program`."""
    for action in all_actions(launch.actions):
        if isinstance(action, Node):
            yield f"{plain_text(action.package)}/{plain_text(action.executable)}", action.line
        if not isinstance(action, Group):
            yield from _by_path(action, action.line)


def _by_path(value: Any, line: int) -> Iterator[tuple[str, int]]:
    """What stands behind the packages that the templates of an action find, each with its line."""
    line = getattr(value, "line", line)
    parts = msgspec.structs.astuple(value) if isinstance(value, msgspec.Struct) else value
    if not isinstance(parts, tuple | list):
        return
    for part, after in zip_longest(parts, parts[1:]):
        if isinstance(part, Substitution) and part.kind == "find" and isinstance(after, str) and after.startswith("/"):
            yield f"{plain_text(part.args[0])}{after.split(maxsplit=1)[0]}", line
        yield from _by_path(part, line)
