"""The names and the texts of a Python file, also of Python 2: what a comment or a docstring holds is neither.

Facts keep what carries values; here everything counts that is written, also what no fact is made of.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from tree_sitter import Node

from ecm_parsers.source.python import syntax_tree
from ecm_parsers.source.python_literal import string_value
from ecm_parsers.source.written import Written
from ecm_parsers.text import decode

_TEXTS: Final = frozenset({"string", "concatenated_string"})


def names(data: bytes) -> Iterator[Written]:
    """Yield the names of a file in order."""
    return (_written(_text(node), node) for node in _nodes(data) if node.type == "identifier")


def texts(data: bytes) -> Iterator[Written]:
    """Yield the texts of a file in order, those in braces of others after these; texts side by side are one."""
    for node in _nodes(data):
        if node.type in _TEXTS and not _is_part(node) and not _is_docstring(node):
            parts = node.named_children if node.type == "concatenated_string" else [node]
            yield _written("".join(string_value(part.text or b"") or "" for part in parts), node)


def _written(text: str, node: Node) -> Written:
    return Written(text, node.start_point[0] + 1)


def _text(node: Node) -> str:
    return (node.text or b"").decode("utf-8", "replace")


def _nodes(data: bytes) -> Iterator[Node]:
    root = syntax_tree(decode(data)[0].encode("utf-8", "replace"))
    pending = [root] if root is not None else []
    while pending:
        node = pending.pop()
        yield node
        pending += reversed(node.named_children)


def _is_part(node: Node) -> bool:
    return node.parent is not None and node.parent.type == "concatenated_string"


def _is_docstring(node: Node) -> bool:
    """Whether a text is a statement, which nothing uses."""
    return node.parent is not None and node.parent.type == "expression_statement" and node.parent.named_child_count == 1
