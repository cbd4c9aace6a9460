"""Names with a namespace, wherever C++ writes them: in types, calls, casts and initialisers alike.

Bodies are reduced to what carries values, so a type that only stands in a cast or a template argument is in no other
fact; consumers of a library name it there all the same.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.facts import Mention

if TYPE_CHECKING:
    from tree_sitter import Node

_MARK: Final = b"::"
_LANGUAGE_OWN: Final = b"std"
"""The namespace of the language itself: no package provides it."""
MAX_MENTIONS: Final = 20_000


def mentions(root: Node, data: bytes) -> tuple[Mention, ...]:
    """Return the qualified names of a file in their order, each once for a place.

    Args:
        root: of its syntax tree.
        data: the text that the tree was made of.
    """
    outermost: dict[int, Node] = {}
    for node in _qualified(root, data):
        # `b::C` inside `a::b::C` ends where the whole does.
        known = outermost.get(node.end_byte)
        if known is None or node.start_byte < known.start_byte:
            outermost[node.end_byte] = node
    named = ((node, _written(node)) for node in outermost.values())
    found = {Mention(name, *_place(node), _arguments(node)) for node, name in named if name}
    return tuple(sorted(found, key=lambda entry: (entry.line, entry.column, entry.name)))


def _qualified(root: Node, data: bytes) -> Iterator[Node]:
    """Nodes of qualified names; their marks are found in the text, which is ten times as fast as walking the tree."""
    at = data.find(_MARK)
    for _ in range(MAX_MENTIONS):
        if at < 0:
            return
        if not data.endswith(_LANGUAGE_OWN, 0, at):
            mark = root.descendant_for_byte_range(at, at + len(_MARK))
            node = mark.parent if mark is not None and mark.type == "::" else None
            if node is not None and node.type == "qualified_identifier":
                yield node
        at = data.find(_MARK, at + len(_MARK))


def _place(node: Node) -> tuple[int, int]:
    row, column = node.start_point
    return row + 1, column + 1


def _written(node: Node) -> str:
    """`a::b::C` without template arguments; empty for what is not made of names alone."""
    text = node.text or b""
    if b"<" not in text and text.replace(b"::", b"").replace(b"_", b"").isalnum():
        return text.decode("ascii", "replace")
    return "::".join(_parts(node))


def _parts(node: Node) -> list[str]:
    parts: list[str] = []
    current: Node | None = node
    while current is not None:
        scope, name = current.child_by_field_name("scope"), current.child_by_field_name("name")
        if scope is not None:
            parts.append(_own(scope))
        if name is not None and name.type != "qualified_identifier":
            parts.append(_own(name))
        current = name if name is not None and name.type == "qualified_identifier" else None
    return parts if all(part.isidentifier() for part in parts) else []


def _own(node: Node) -> str:
    """The name of a part, whose template arguments stand in a node of their own."""
    named = node.child_by_field_name("name") or node
    return (named.text or b"").decode("utf-8", "replace")


def _arguments(node: Node) -> int:
    """How many arguments a call of the name gives; -1 where it is not called."""
    call = node.parent
    if call is None or call.type != "call_expression" or call.child_by_field_name("function") != node:
        return -1
    given = call.child_by_field_name("arguments")
    return -1 if given is None else sum(child.type != "comment" for child in given.named_children)
