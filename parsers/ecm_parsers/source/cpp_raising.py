"""What is thrown and caught in C++, by type."""

from __future__ import annotations

from tree_sitter import Node

from ecm_parsers.source.cpp_expr import ExprReader


def types_caught(expr: ExprReader, clause: Node) -> tuple[str, ...]:
    """Return the type that a handler is for; none for `catch (...)`."""
    listed = clause.child_by_field_name("parameters")
    given = [child for child in listed.named_children if child.type == "parameter_declaration"] if listed else []
    kind = given[0].child_by_field_name("type") if given else None
    if kind is None:
        return ()
    declarator = given[0].child_by_field_name("declarator")
    pointer = declarator is not None and "pointer" in declarator.type
    return (expr.text(kind) + (" *" if pointer else ""),)


def type_thrown(expr: ExprReader, node: Node) -> str:
    """Return the type of what is thrown: the text of what does not show its type, nothing for `throw;`."""
    value = next((child for child in node.named_children if child.type != "comment"), None)
    if value is None:
        return ""
    if value.type == "number_literal" and expr.text(value).isdigit():
        return "int"
    made = value.child_by_field_name("function") or value.child_by_field_name("type")
    return expr.text(made or value)
