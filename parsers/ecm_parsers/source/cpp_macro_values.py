"""What a `#define` stands for, where that is a value."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from ecm_parsers.source.cpp_declarators import first_value
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_parser import parser
from ecm_parsers.source.expr import Expr

MAX_LENGTH = 200
"""A longer text, in bytes, is code and no value."""
_BEFORE = b"auto x = "


def macro_value(text: bytes) -> Expr | None:
    """Return the value that a text after the name of a macro is; None for code and for an empty text."""
    text = _without_comment(text)
    if len(text) >= MAX_LENGTH:
        return None
    side_by_side = _joined(text)
    return _read(text) or (_read(side_by_side) if side_by_side is not None else None)


def _without_comment(text: bytes) -> bytes:
    """The text before a comment to the end of the line, which the grammar leaves in it; `//` within a text is none."""
    if b"//" not in text:
        return text
    start = len(_BEFORE)
    comment = next(_comments(parser().parse(_BEFORE + text + b"\n;").root_node), None)
    return text[: comment.start_byte - start].strip() if comment is not None else text


def _comments(node: Node) -> Iterator[Node]:
    if node.type == "comment" and node.text is not None and node.text.startswith(b"//"):
        yield node
    for child in node.children:
        yield from _comments(child)


def _read(text: bytes) -> Expr | None:
    declaration = _BEFORE + text + b";"
    found = first_value(parser().parse(declaration).root_node)
    return ExprReader(declaration, lambda body: None).read(found) if found is not None else None


def _joined(text: bytes) -> bytes | None:
    """`PREFIX NAME`: macros side by side, which the grammar takes for texts only beside a literal."""
    words = text.split()
    return b' "" '.join(words) if len(words) > 1 and all(map(_is_part, words)) else None


def _is_part(word: bytes) -> bool:
    """Tell whether a word is a whole text or may be the macro of one."""
    is_text = len(word) > 1 and word.startswith(b'"') and word.endswith(b'"')
    return is_text or word.decode(errors="replace").isidentifier()
