"""Arrays of C++ as their declarators write them: `Part parts[2] = {...}`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_effects import has_call
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.expr import Expr, Items, Op, Opaque

if TYPE_CHECKING:
    from tree_sitter import Node

_AROUND = frozenset({"pointer_declarator", "array_declarator"})


def extents(declarator: Node) -> str:
    """Return `[]` for each dimension of an array, whose elements may be pointers; nothing for anything else."""
    return "[]" * len(_dimensions(declarator))


def characters(reader: ExprReader, kind: Node, declarator: Node) -> Expr | None:
    """Return how many characters an array of them has; None for anything else, and where braces or a text tell."""
    sizes = [each.child_by_field_name("size") for each in _dimensions(declarator)]
    size = sizes[0] if len(sizes) == 1 and reader.text(kind) == "char" else None
    return reader.read(size) if size is not None and declarator.type == "array_declarator" else None


def array_value(reader: ExprReader, kind: Node, declarator: Node, value: Node) -> Expr | None:
    """Return what an array begins with: what braces list, which may be less than it has; None for anything else.

    Arrays of characters are texts.
    """
    dimensions = _dimensions(declarator)
    if value.type != "initializer_list" or not dimensions:
        return None
    if reader.text(kind) == "char" and declarator.type != "pointer_declarator":
        return None
    items = reader.arguments(value)
    size = dimensions[-1].child_by_field_name("size")
    stated = reader.text(size) if size is not None else ""
    if not stated.isdecimal() or int(stated) == len(items):
        return Items(items)
    return Op("{}", items) if any(map(has_call, items)) else Opaque("{}")


def _dimensions(declarator: Node) -> list[Node]:
    """The dimensions of an array, the last one first."""
    found: list[Node] = []
    node: Node | None = declarator
    while node is not None and node.type in _AROUND:
        found += [node] if node.type == "array_declarator" else []
        node = node.child_by_field_name("declarator")
    return [] if node is not None and node.type == "parenthesized_declarator" else found
