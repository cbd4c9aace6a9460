"""Objects that are cast to another class: `static_cast<Own *>(this)->topic`, `static_cast<const Base &>(own).name()`.

What stands behind the cast is a member of that class; the tree as a whole tells which one it is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import CAST, Call, Expr, Name

if TYPE_CHECKING:
    from tree_sitter import Node

    from ecm_parsers.source.cpp_expr import ExprReader

_CASTS = frozenset({"static_cast", "dynamic_cast", "reinterpret_cast"})
_REFERRING = ("*", "&")


def object_cast(reader: ExprReader, node: Node) -> Expr:
    """Return the object whose member is named, as a call of `CAST` where it is cast, or of the class for a copy."""
    written = cast_type(reader, node)
    value = reader.read(node)
    if not written:
        return value
    referring = written.endswith(_REFERRING)
    return Call(CAST if referring else Name(written), (value,), (), (written,) * referring, node.start_point[0] + 1)


def cast_type(reader: ExprReader, node: Node) -> str:
    """Return the type that an expression is cast to, as written; empty for others."""
    node = _bare(node)
    if node.type == "cast_expression":
        kind, marks = node.child_by_field_name("type"), node.child_by_field_name("value")
        return reader.type_text(kind) if kind is not None and marks is not None else ""
    function = node.child_by_field_name("function") if node.type == "call_expression" else None
    if function is None or function.type != "template_function" or reader.name(function) not in _CASTS:
        return ""
    types = reader.template_arguments(function)
    return types[0] if len(types) == 1 else ""


def cast_class(reader: ExprReader, kind: Node, value: Node | None) -> str:
    """Return the type that a variable has which is declared as `auto` and begins with such a cast; else nothing."""
    written = cast_type(reader, value) if value is not None and reader.text(kind) == "auto" else ""
    return written.rstrip("& ") if written.endswith(_REFERRING) else ""


def _bare(node: Node) -> Node:
    """What stands in parentheses, or is pointed to."""
    while node.type in {"parenthesized_expression", "pointer_expression"} and node.named_child_count == 1:
        node = node.named_children[0]
    return node
