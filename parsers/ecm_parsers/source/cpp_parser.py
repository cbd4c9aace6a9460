"""The C++ grammar, and the reading of a text that costs least errors."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from time import monotonic
from typing import TYPE_CHECKING

import tree_sitter_cpp
from tree_sitter import Language, Parser

from ecm_parsers.source import cpp_text
from ecm_parsers.source.cpp_branches import with_one_branch
from ecm_parsers.source.cpp_conditionals import without_conditionals
from ecm_parsers.source.cpp_word_operators import with_signs

if TYPE_CHECKING:
    from tree_sitter import Node, Tree


MAX_SECONDS = 5.0
SMALL_BYTES = 16_000
"""Below this size even the worst known input parses within the bound, so no clock is watched."""


class TooSlowError(Exception):
    """The grammar's recovery from errors takes longer than `MAX_SECONDS`."""


@cache
def parser() -> Parser:
    """Return the parser, made once per process."""
    return Parser(Language(tree_sitter_cpp.language()))


def parse_tree(data: bytes) -> tuple[Tree, bytes]:
    """Parse as it is; on errors without macros, and then without conditionals, whichever reads more.

    Raises:
        TooSlowError: it takes longer than the bound.

    A missing `;` after a macro spoils nothing, so only real errors are worth a second parse.
    """
    tree = _parse(data)
    if first_error(tree.root_node) is None and not cpp_text.hides_class(data):
        return tree, data
    rewritten = with_one_branch(cpp_text.without_macros(with_signs(data)))
    if rewritten != data:
        tree, data = _parse(rewritten), rewritten
    if b"#if" in data and first_error(tree.root_node) is not None:
        return _less_torn(tree, data)
    return tree, data


def _less_torn(tree: Tree, data: bytes) -> tuple[Tree, bytes]:
    """Parse without the conditionals that errors touch, then without any; what leaves less unread is taken."""
    unread = _unread(tree.root_node)
    touched = without_conditionals(data, [(error.start_byte, error.end_byte) for error in _errors(tree.root_node)])
    for bare in dict.fromkeys((touched, without_conditionals(data))):
        if unread and bare != data:
            other = _parse(bare)
            left = _unread(other.root_node)
            if left < unread:
                tree, data, unread = other, bare, left
    return tree, data


def _unread(root: Node) -> int:
    """How many bytes the outermost errors span, and one for each thing that is missing."""
    return sum(1 if error.is_missing else error.end_byte - error.start_byte for error in _errors(root))


def _errors(root: Node) -> Iterator[Node]:
    """Yield the outermost errors, and what is missing, but for a `;`."""
    pending = [root]
    while pending:
        node = pending.pop()
        if node.type == "ERROR" or node.is_missing:
            if node.type != ";":
                yield node
        else:
            pending.extend(child for child in node.children if child.has_error)


def _parse(data: bytes) -> Tree:
    """Parse one text.

    Raises:
        TooSlowError: it takes longer than the bound.
    """
    if len(data) < SMALL_BYTES:
        return parser().parse(data)
    end = monotonic() + MAX_SECONDS
    try:
        return parser().parse(
            lambda offset, _point: data[offset : offset + 65_536],
            progress_callback=lambda _offset, _error: monotonic() > end,
        )
    except ValueError:
        # Without it the parser would go on with this text at the next call.
        parser().reset()
        raise TooSlowError from None


def first_error(root: Node) -> Node | None:
    """Return the first ERROR node, or what the parser missed; a missing `;` does not count."""
    pending = [root] if root.has_error else []
    while pending:
        node = pending.pop()
        if node.type == "ERROR" or (node.is_missing and node.type != ";"):
            return node
        pending.extend(child for child in reversed(node.children) if child.has_error)
    return None
