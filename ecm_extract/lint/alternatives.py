"""Lines that stand in one branch of several: what is old there is kept for those who need it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import takewhile
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.cmake_tokens import parse_commands
from ecm_parsers.source.cpp_directives import directives
from ecm_parsers.source.python import syntax_tree

if TYPE_CHECKING:
    from tree_sitter import Node

_CMAKE: Final = ("CMakeLists.txt", ".cmake")
_CHOOSES: Final = frozenset(
    {b"ros_distro", b"ros_version", b"ros_python_version", b"rosdistro", b"rosversion", b"version_info"}
)
"""Names and texts, in lower case, that tell a distribution, or a version of Python, from another."""
_NAMED: Final = frozenset({"identifier", "string_content"})


class _Mark(NamedTuple):
    """What opens, goes on with or closes a condition: its word in lower case, and its 1-based line."""

    word: str
    line: int


def has_alternative(path: str, data: bytes, line: int) -> bool:
    """Tell whether a line is in one branch of several.

    Branches are conditions of the preprocessor and of CMake with a second one, and in Python a `try`, and what the
    distribution chooses.

    Args:
        path: of the file, whose ending tells the language.
        data: its content.
        line: 1-based.
    """
    if path.endswith(".py"):
        return any(_is_choice(around, inner) for inner, around in _around(data, line))
    marks = _of_cmake(data) if path.endswith(_CMAKE) else _of_preprocessor(data)
    return _is_branched(marks, line)


def _is_branched(marks: Iterable[_Mark], line: int) -> bool:
    blocks: list[tuple[int, bool]] = []
    for mark in marks:
        if mark.word.startswith("if"):
            blocks.append((mark.line, False))
        elif mark.word.startswith("el") and blocks:
            blocks[-1] = (blocks[-1][0], True)
        elif mark.word == "endif" and blocks:
            start, has_other = blocks.pop()
            if has_other and start < line < mark.line:
                return True
    return False


def _of_preprocessor(data: bytes) -> Iterator[_Mark]:
    for each in directives(data):
        yield _Mark(each.word.decode("ascii", "replace"), data.count(b"\n", 0, each.start) + 1)


def _of_cmake(data: bytes) -> Iterator[_Mark]:
    return (_Mark(command.name, command.line) for command in parse_commands(data).facts)


def _around(data: bytes, line: int) -> Iterator[tuple[Node, Node]]:
    """Yield what the statement of a line stands in, from the inside, each with what it is in that."""
    text = data.decode("utf-8", "replace")
    lines = text.splitlines()
    own = lines[line - 1] if 0 < line <= len(lines) else ""
    at = (line - 1, len(own.encode()) - len(own.lstrip().encode()))
    root = syntax_tree(text.encode("utf-8", "replace")) if own.strip() else None
    node = root.descendant_for_point_range(at, at) if root is not None else None
    while node is not None and node.parent is not None:
        yield node, node.parent
        node = node.parent


def _is_choice(around: Node, inner: Node) -> bool:
    """Tell whether a part of a statement is one of several: of a `try`, or of a test that tells versions apart."""
    if around.type == "try_statement":
        return True
    if around.type == "elif_clause":
        return _tells_version(around)
    if around.type != "if_statement":
        return False
    before = takewhile(lambda each: each != inner, around.children_by_field_name("alternative"))
    tests = [around, *before] if inner.type == "else_clause" else [around] if inner.type == "block" else []
    return any(_tells_version(test) for test in tests)


def _tells_version(branch: Node) -> bool:
    pending = [branch.child_by_field_name("condition")]
    while pending:
        node = pending.pop()
        if node is not None:
            if node.type in _NAMED and (node.text or b"").lower() in _CHOOSES:
                return True
            pending += node.children
    return False
