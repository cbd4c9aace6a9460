"""Expressions of C++ as statements: what they assign, and that they call something."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_effects import has_call, shifted
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_logging import Printing, macro_that_prints
from ecm_parsers.source.cpp_statements import StatementWriter
from ecm_parsers.source.cpp_writes import written
from ecm_parsers.source.expr import Call, Expr, Name, Number, Op, Opaque

if TYPE_CHECKING:
    from collections.abc import Mapping

    from tree_sitter import Node

_ASSIGNING = frozenset({"-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>="})


class Assigning:
    """Writes the statements that the expressions of one body are.

    Attributes:
        expr: reads them.
        writer: takes the statements.
        buffers: how many characters the arrays of the body have, by their names.
    """

    def __init__(self, expr: ExprReader, writer: StatementWriter, buffers: Mapping[str, Expr]) -> None:
        self.expr = expr
        self.writer = writer
        self.buffers = buffers
        self._printing = Printing(expr, writer)

    def expression(self, node: Node) -> None:
        """Read an expression whose value nobody takes."""
        macro = macro_that_prints(node)
        if macro:
            self._printing.read(macro, node)
            return
        if node.type in {"comma_expression", "parenthesized_expression"}:
            for child in node.named_children:
                self.expression(child)
            return
        if node.type == "fold_expression":
            self._folded(node)
            return
        counter = node.child_by_field_name("argument") if node.type == "update_expression" else None
        if counter is not None:
            self._counted(node, self.expr.read(counter))
            return
        self.effect(node, self.expr.read(node))

    def _folded(self, node: Node) -> None:
        """`((out += rest), ...);` leaves what nobody knows: it is done for each of a pack. Source: [expr.prim.fold]."""
        for side in (node.child_by_field_name("left"), node.child_by_field_name("right")):
            while side is not None and side.type == "parenthesized_expression":
                side = next(iter(side.named_children), None)
            if side is None:
                continue
            changed = side.child_by_field_name("left") if side.type == "assignment_expression" else side
            if side.type == "call_expression":
                self.expression(side)
            elif changed is not None:
                self._set(node, self.expr.read(changed), Opaque("..."))

    def effect(self, node: Node, value: Expr) -> None:
        """Write what an expression assigns, or that it calls something."""
        if isinstance(value, Op) and value.op == "=" and len(value.operands) == 2:
            target, assigned = value.operands
            if isinstance(assigned, Op) and assigned.op == "=":
                self._chained(node, value)
            else:
                self._set(node, target, assigned)
        elif isinstance(value, Op) and value.op == "+=":
            self._set(node, value.operands[0], Op("+", value.operands))
        elif isinstance(value, Op) and value.op in _ASSIGNING:
            self._set(node, value.operands[0], Op(value.op[:-1], value.operands))
        elif isinstance(value, Op) and value.op == "<<":
            self._stream(node, value)
        elif isinstance(value, Op) and value.op == ">>":
            self._streamed_out(node, value)
        elif isinstance(value, Call) and (write := written(value, self.buffers)) is not None:
            self._set(node, *write)
        elif has_call(value):
            self.writer.add("do", node, value)

    def within(self, node: Node, value: Expr) -> None:
        """`while (stream >> name)` and `if ((n = next()) > 0)` change variables before they are decided."""
        if not isinstance(value, Op):
            return
        if value.op in {">>", "="}:
            self.effect(node, value)
            return
        for operand in value.operands:
            self.within(node, operand)

    def _set(self, node: Node, target: Expr, value: Expr) -> None:
        self.writer.add("set", node, value, target)

    def _counted(self, node: Node, counter: Expr) -> None:
        """What `++index;` and `index--;` give the index."""
        operator = node.child_by_field_name("operator")
        sign = "+" if operator is not None and operator.type == "++" else "-"
        self._set(node, counter, Op(sign, (counter, Number(1))))

    def _streamed_out(self, node: Node, value: Op) -> None:
        """`stream >> a >> b` writes what nobody knows."""
        left: Expr = value
        while isinstance(left, Op) and left.op == ">>" and len(left.operands) == 2:
            self._set(node, left.operands[1], Opaque(">>"))
            left = left.operands[0]

    def _chained(self, node: Node, value: Expr) -> None:
        """`a = b = c` gives `c` to both."""
        targets: list[Expr] = []
        while isinstance(value, Op) and value.op == "=" and len(value.operands) == 2:
            targets.append(value.operands[0])
            value = value.operands[1]
        for target in reversed(targets):
            self._set(node, target, value)

    def _stream(self, node: Node, value: Op) -> None:
        """`stream << a << b` appends to the stream."""
        parts = shifted(value)
        if isinstance(parts[0], Name) and "::" not in parts[0].id:
            self._set(node, parts[0], Op("+", tuple(parts)))
        elif has_call(value):
            self.writer.add("do", node, value)
