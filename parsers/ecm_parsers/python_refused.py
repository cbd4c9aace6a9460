"""Python that no reader takes: in doubt it is taken, since a syntax may be newer, or older, than what reads it here.

The parser of Python itself says what it refuses, and the syntax tree, which knows every version, what is only of
another one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

from tree_sitter import Node

from ecm_parsers.python.syntax import parsed
from ecm_parsers.result import Diagnostic, diagnostic
from ecm_parsers.source.python import MAX_BYTES, syntax_tree

CODE: Final = "python-refused"
_ADVICE: Final = "Correct the line"
_NEWER: Final = frozenset({"type_alias_statement"})
_DEFINITIONS: Final = frozenset({"class_definition", "function_definition"})
_ONCE_NAMES: Final = frozenset({b"async", b"await", b"nonlocal", b"None", b"True", b"False"})
"""Words that Python 2, or a Python 3 of before, takes for names."""
_STATEMENT_ONCE: Final = "Missing parentheses in call to"
"""What is said of the statements `print` and `exec` of Python 2."""
_NEAR: Final = 1
"""Lines between where the two parsers see the same mistake."""


def refused_by_python3(data: bytes) -> Diagnostic | None:
    """Return what Python 3 refuses in a file, None where that may be syntax of a newer one."""
    error = _error(data)
    if error is None or isinstance(error, IndentationError):
        return _told(error)
    root = syntax_tree(data)
    return None if root is None or (not root.has_error and _is_newer(root, error.lineno or 0)) else _told(error)


def refused_by_every_python(data: bytes) -> Diagnostic | None:
    """Return what neither Python 2 nor Python 3 takes in a file; tabs beside blanks are right in Python 2."""
    error = _error(data)
    if error is None or isinstance(error, TabError):
        return None
    if isinstance(error, IndentationError):
        return _told(error)
    root = syntax_tree(data)
    line = error.lineno or 0
    if root is None or str(error.msg).startswith(_STATEMENT_ONCE) or not _breaks_near(root, line):
        return None
    return None if _has_once(root, line) else _told(error)


def _error(data: bytes) -> SyntaxError | None:
    """What Python says of a file; it is parsed and not run."""
    if len(data) > MAX_BYTES:
        return None
    try:
        parsed(data)
    except SyntaxError as error:
        return error
    except (RecursionError, MemoryError, ValueError):
        return None
    return None


def _told(error: SyntaxError | None) -> Diagnostic | None:
    return diagnostic("error", CODE, error.lineno or 1, str(error.msg), _ADVICE) if error is not None else None


def _is_newer(root: Node, line: int) -> bool:
    """Tell whether a file has aliases and parameters of types, or a formatted text on the line that is refused."""
    return any(_is_of_later(node, line) for node in _nodes(root, lambda _: True))


def _is_of_later(node: Node, line: int) -> bool:
    if node.type == "type_parameter":
        return node.parent is not None and node.parent.type in _DEFINITIONS
    return node.type in _NEWER or (node.type == "interpolation" and _touches(node, line))


def _breaks_near(root: Node, line: int) -> bool:
    broken = _nodes(root, lambda node: node.has_error)
    return any((node.is_error or node.is_missing) and abs(node.start_point[0] + 1 - line) <= _NEAR for node in broken)


def _has_once(root: Node, line: int) -> bool:
    """Whether a line has a name or sign that Python 3 has no more; a text is a copy of all, so it is taken once."""
    whole, first = root.text or b"", root.start_byte
    words = (whole[leaf.start_byte - first : leaf.end_byte - first] for leaf in _leaves(root, line))
    return any(word in _ONCE_NAMES or word == b"`" for word in words)


def _leaves(root: Node, line: int) -> Iterator[Node]:
    return (node for node in _nodes(root, lambda node: _touches(node, line)) if not node.child_count)


def _touches(node: Node, line: int) -> bool:
    return node.start_point[0] + 1 <= line <= node.end_point[0] + 1


def _nodes(root: Node, wanted: Callable[[Node], bool]) -> Iterator[Node]:
    """Yield a node and all below it that are wanted, as are those around them."""
    stack = [root]
    while stack:
        node = stack.pop()
        yield node
        stack.extend(child for child in node.children if wanted(child))
