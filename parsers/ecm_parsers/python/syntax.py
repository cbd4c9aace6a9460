"""Text of Python 2 or 3 -> the tree of Python itself.

What Python 2 writes in another way is written anew, by the type of its node; what no Python takes is left out.
"""

from __future__ import annotations

import ast
import re
import warnings
from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple

from tree_sitter import Node

from ecm_parsers.source.python import syntax_tree

_MAX_LEFT_OUT = 20
"""Statements that are left out one by one, since Python refuses them."""
_BLOCKS = frozenset({"module", "block"})
_PREFIX = re.compile(rb"[A-Za-z]*")
_INDENT = re.compile(r"^[ \t]*\t[ \t]*", re.MULTILINE)
Spans = frozenset[tuple[int, int]]
"""First and one past the last byte of each."""


class Syntax(NamedTuple):
    """The statements of a file; `is_whole` where all of them could be read."""

    module: ast.Module
    is_whole: bool


def parsed(text: str | bytes) -> ast.Module:
    """Return the tree of a text of this Python.

    Raises:
        SyntaxError, RecursionError, MemoryError, ValueError: what Python raises where it refuses a text.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return ast.parse(text)


def of_either_python(text: str) -> Syntax:
    """Return the tree of a text of any Python, of one with mistakes what is left without them."""
    try:
        return Syntax(parsed(text), is_whole=True)
    except SyntaxError:
        data = _INDENT.sub(lambda blanks: blanks[0].expandtabs(8), text).encode("utf-8", "replace")
        root = syntax_tree(data)
        return Syntax(ast.Module([], []), is_whole=False) if root is None else _without_mistakes(data, root)
    except (RecursionError, MemoryError, ValueError):
        return Syntax(ast.Module([], []), is_whole=False)


def _without_mistakes(data: bytes, root: Node) -> Syntax:
    left_out: Spans = frozenset()
    for _ in range(_MAX_LEFT_OUT):
        try:
            return Syntax(parsed(_rewritten(data, root, left_out)), is_whole=not root.has_error and not left_out)
        except SyntaxError as error:
            refused = _refused_on(root, (error.lineno or 1) - 1, left_out)
            if refused is None:
                break
            left_out |= {_span(refused)}
        except (RecursionError, MemoryError, ValueError):
            break
    return Syntax(ast.Module([], []), is_whole=False)


def _span(node: Node) -> tuple[int, int]:
    return node.start_byte, node.end_byte


def _rewritten(data: bytes, root: Node, left_out: Spans) -> bytes:
    """Return a text as Python 3 writes it, on the lines that it had."""
    parts: list[bytes] = []
    position = 0
    for node, text in _edits(data, root, left_out):
        parts += [data[position : node.start_byte], text]
        position = node.end_byte
    return b"".join([*parts, data[position:]])


def _edits(data: bytes, root: Node, left_out: Spans) -> Iterator[tuple[Node, bytes]]:
    """Yield nodes and what stands for them; what is around a node is handed down, since asking it takes long."""
    pending = [(root, "")]
    while pending:
        node, around = pending.pop()
        is_left_out = _span(node) in left_out or _is_broken(node, around)
        row = _nothing if is_left_out else _ROWS.get((around, node.type), _ROWS.get(("", node.type)))
        text = row(data[node.start_byte : node.end_byte], node) if row is not None else None
        if text is None:
            pending += [(child, node.type) for child in reversed(node.children)]
        else:
            yield node, text


def _is_broken(node: Node, around: str) -> bool:
    """Whether a statement has a mistake that is not inside a statement below it."""
    if not node.has_error or around not in _BLOCKS:
        return False
    return node.is_error or any(child.has_error and child.type not in _HOLDING for child in node.children)


def _refused_on(root: Node, row: int, left_out: Spans) -> Node | None:
    """The innermost statement on a line, counted from 0; before it a text with values in it, which newer ones take."""
    found = formatted = None
    pending = [(root, "")]
    while pending:
        node, around = pending.pop()
        if _span(node) not in left_out and node.start_point[0] <= row <= node.end_point[0]:
            found = node if around in _BLOCKS else found
            formatted = node if any(child.type == "interpolation" for child in node.children) else formatted
            pending += [(child, node.type) for child in node.children]
    return formatted or found


def _nothing(text: bytes, _: Node) -> bytes:
    """A name that nothing has."""
    return b"(_" + b"\n" * text.count(b"\n") + b")"


def _raise(text: bytes, node: Node) -> bytes | None:
    """`raise Error, "text"`; what is raised does not matter."""
    listed = node.named_child(0)
    return b"raise " + _nothing(text, node) if listed is not None and listed.type == "expression_list" else None


def _integer(text: bytes, _: Node) -> bytes:
    """`0755`, `10L`."""
    digits = text.rstrip(b"lL")
    is_octal = digits[:1] == b"0" and digits.isdigit() and digits.strip(b"0") != b""
    return b"0o" + digits.lstrip(b"0") if is_octal else digits


def _string(text: bytes, _: Node) -> bytes | None:
    """`ur"..."`, and the text of a value in backticks."""
    if text[:1] == b"`":
        return b"repr(" + text[1:-1] + b")"
    prefix = _PREFIX.match(text)
    letters = prefix[0] if prefix is not None else b""
    return letters.lower().replace(b"u", b"") + text[len(letters) :] if letters.lower() == b"ur" else None


def _pattern(text: bytes, _: Node) -> bytes:
    """`def f(a, (b, c))`."""
    return b"_" + b"\\\n" * text.count(b"\n")


_HOLDING = frozenset({"block", "elif_clause", "else_clause", "except_clause", "finally_clause", "case_clause"})
_ROWS: Mapping[tuple[str, str], Callable[[bytes, Node], bytes | None]] = MappingProxyType(
    {
        ("", "print_statement"): _nothing,
        ("", "exec_statement"): _nothing,
        ("", "raise_statement"): _raise,
        ("", "integer"): _integer,
        ("", "string"): _string,
        ("", "<>"): lambda *_: b"!=",
        ("except_clause", ","): lambda *_: b" as ",
        ("parameters", "tuple_pattern"): _pattern,
        ("lambda_parameters", "tuple_pattern"): _pattern,
    }
)
"""By the type of the node around, empty for any, and of the node."""
