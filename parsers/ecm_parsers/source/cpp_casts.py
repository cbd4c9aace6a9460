"""Arguments that are cast to a number: `static_cast<double>(0)` and `(double)0` are `double(0)`, no integer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Name

if TYPE_CHECKING:
    from tree_sitter import Node

    from ecm_parsers.source.cpp_expr import ExprReader

_NUMBERS = frozenset({"bool", "int", "long", "unsigned", "float", "double", "size_t"}) | {
    f"{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)
}


def cast_arguments(reader: ExprReader, listed: Node | None) -> tuple[Expr, ...]:
    """Return the arguments of a call, those that are cast to a number as calls of that number."""
    if listed is None:
        return ()
    return tuple([_argument(reader, child) for child in listed.named_children if child.type != "comment"])


def _argument(reader: ExprReader, node: Node) -> Expr:
    value = reader.read(node)
    if node.type not in {"cast_expression", "call_expression"}:
        return value
    number = _number(reader, node)
    return Call(Name(number), (value,), (), (), node.start_point[0] + 1) if number else value


def _number(reader: ExprReader, node: Node) -> str:
    """The type of number that an expression is cast to, empty for others."""
    if node.type == "cast_expression":
        kind = node.child_by_field_name("type")
        written = reader.text(kind) if kind is not None else ""
    else:
        function = node.child_by_field_name("function")
        if function is None or function.type != "template_function" or reader.name(function) != "static_cast":
            return ""
        types = reader.template_arguments(function)
        written = types[0] if len(types) == 1 else ""
    words = written.split()
    return words[0].removeprefix("std::") if words and words[0].removeprefix("std::") in _NUMBERS else ""
