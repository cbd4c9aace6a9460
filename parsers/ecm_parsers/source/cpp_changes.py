"""Variables of C++ that change within an expression: `open("joint" + std::to_string(count++))`.

Each change is a statement of its own before the one that it stands in; what the expression gets is kept under a name
that no code has. What may not happen (`a && b++`), and what is read beside its change (`names[n] + text(n++)`), whose
order nobody knows, leaves a variable that is not known. Source: [expr.post.incr], [expr.pre.incr], [intro.execution].
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_statements import StatementWriter
from ecm_parsers.source.expr import Expr, Name, Number, Op, Opaque

if TYPE_CHECKING:
    from tree_sitter import Node

_WHOLE = frozenset({"declaration", "condition_clause", "field_initializer", "lambda_expression", "for_statement"})
MAX_STATEMENT = 4_000
"""In a longer statement, in bytes, a variable counts as one that stands elsewhere in it."""
_AS_STATEMENTS = frozenset({"expression_statement", "comma_expression", "for_statement"})


class Changes:
    """Writes what expressions change on the way.

    Args:
        writer: takes the statements.
    """

    def __init__(self, writer: StatementWriter) -> None:
        self.writer = writer

    def within(self, reader: ExprReader, node: Node) -> Expr | None:
        """Write what an assignment or a count changes, and return what the expression gets.

        Returns:
            None where it is a statement of its own, which others read.
        """
        target_node = node.child_by_field_name("argument") or node.child_by_field_name("left")
        if target_node is None or _is_by_itself(node):
            return None
        target = reader.read(target_node)
        value = _value(reader, node, target)
        if _may_not_happen(node) or _is_read_beside(node, target_node):
            value = Opaque(reader.text(node)[:80])
            self.writer.add("set", node, value, target)
            return value
        if node.type == "assignment_expression" or node.children[0].type in {"++", "--"}:
            self.writer.add("set", node, value, target)
            return target
        row, column = node.start_point
        before = Name(f"#{row + 1}:{column + 1}")
        self.writer.add("let", node, target, before, "auto")
        self.writer.add("set", node, value, target)
        return before


def _is_by_itself(node: Node) -> bool:
    """Whether an assignment or a count is a statement, or the condition of one."""
    around = node.parent
    while around is not None and around.type == "parenthesized_expression":
        around = around.parent
    if around is None or around.type in _AS_STATEMENTS:
        return True
    return node.type == "assignment_expression" and around.type in {"assignment_expression", "condition_clause"}


def _value(reader: ExprReader, node: Node, target: Expr) -> Expr:
    operator = node.child_by_field_name("operator")
    sign = operator.type if operator is not None else "="
    if node.type == "update_expression":
        return Op("+" if sign == "++" else "-", (target, Number(1)))
    right = node.child_by_field_name("right")
    value = reader.read(right) if right is not None else Opaque("=")
    return value if sign == "=" else Op(sign.removesuffix("="), (target, value))


def _may_not_happen(node: Node) -> bool:
    """Whether it stands on a side of an operator that need not be evaluated."""
    while node.parent is not None and not _is_whole(node):
        around = node.parent
        if around.type == "conditional_expression" and node != around.child_by_field_name("condition"):
            return True
        operator = around.child_by_field_name("operator") if around.type == "binary_expression" else None
        if operator is not None and operator.type in {"&&", "||"} and node == around.child_by_field_name("right"):
            return True
        node = around
    return False


def _is_read_beside(node: Node, target: Node) -> bool:
    """Whether the variable stands elsewhere in the statement as well."""
    whole = node
    while whole.parent is not None and not _is_whole(whole):
        whole = whole.parent
    if whole.end_byte - whole.start_byte > MAX_STATEMENT:
        return True
    return sum(1 for each in _identifiers(whole) if each.text == target.text) > 1


def _is_whole(node: Node) -> bool:
    return node.type.endswith("_statement") or node.type in _WHOLE


def _identifiers(node: Node) -> Iterator[Node]:
    if node.type in {"identifier", "field_expression"}:
        yield node
    if node.type != "field_expression":
        for child in node.named_children:
            yield from _identifiers(child)
