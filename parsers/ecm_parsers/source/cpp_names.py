"""Names in expressions of C++, and lambdas that are called where they stand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Name, Specialized

if TYPE_CHECKING:
    from tree_sitter import Node

    from ecm_parsers.source.cpp_expr import ExprReader


def plain_name(reader: ExprReader, node: Node) -> Name:
    """A name without template arguments; the object at hand is `this`."""
    name = reader.name(node)
    return Name("this" if name in reader.own else reader.brought.meant(name))


def specialized(reader: ExprReader, node: Node) -> Expr:
    """A name that may end in template arguments."""
    name, last = plain_name(reader, node), node
    while last.type == "qualified_identifier" and (following := last.child_by_field_name("name")) is not None:
        last = following
    types = reader.template_arguments(last) if last.type == "template_function" else ()
    return Specialized(name.id, types) if types else name


def called_lambda(reader: ExprReader, function: Node) -> Expr | None:
    """`[&] { ... }()`: the name of the function that the lambda is read as; None for what is no lambda."""
    while function.type == "parenthesized_expression" and function.named_child_count == 1:
        function = function.named_children[0]
    if function.type != "lambda_expression" or reader.called is None or function.child_by_field_name("body") is None:
        return None
    with reader.before():
        return Name(reader.called(function))
