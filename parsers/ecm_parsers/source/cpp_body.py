"""Statements of a C++ function body."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from msgspec.structs import replace

from ecm_parsers.source.cpp_effects import has_call, keeps_number, matters, shifted
from ecm_parsers.source.cpp_expr import ExprReader, lambda_types
from ecm_parsers.source.cpp_parameters import declared_name, parameters
from ecm_parsers.source.cpp_vexing import as_arguments, loop_macro
from ecm_parsers.source.cpp_writes import written
from ecm_parsers.source.expr import Call, Expr, Items, Lambda, Name, Number, Op, Opaque
from ecm_parsers.source.facts import Function, Statement, StatementKind

if TYPE_CHECKING:
    from tree_sitter import Node

MAX_NESTING = 200
_BLOCKS = frozenset(
    {
        "compound_statement",
        "else_clause",
        "case_statement",
        "labeled_statement",
        "preproc_if",
        "preproc_ifdef",
    }
    | {"preproc_else", "preproc_elif", "preproc_elifdef", "ERROR"}
)
_BRANCHES = frozenset(
    {"if_statement", "for_statement", "while_statement", "do_statement", "switch_statement"}
    | {"try_statement", "catch_clause", "for_range_loop"}
)
_MARKS = {"pointer_declarator": " *", "reference_declarator": " &"}
_LOGGING = ("RCLCPP_", "ROS_", "RCUTILS_", "ASSERT_", "EXPECT_")


class BodyReader:
    """Collects the statements of one function, those of its anonymous lambdas included.

    Attributes:
        statements: what was read so far, in source order.
        functions: lambdas bound to a name, read as functions of their own.
        types: `using A = B` and typedefs, whoever reads declarations reads them.
    """

    def __init__(self, data: bytes, scope: str) -> None:
        self.expr = ExprReader(data, self._lambda_body)
        self.scope = scope
        self.statements: list[Statement] = []
        self.functions: list[Function] = []
        self.types: list[Node] = []
        self._depth = 0
        self._lambdas = 0
        self._nesting = 0

    def read(self, node: Node) -> None:
        """Read one statement, or a block of them."""
        if self._nesting >= MAX_NESTING:
            return
        self._nesting += 1
        kind = node.type
        if kind in _BLOCKS:
            for child in node.named_children:
                self.read(child)
        elif kind in _BRANCHES:
            self._branch(node)
        elif (step := _STEPS.get(kind)) is not None:
            step(self, node)
        self._nesting -= 1

    def _expressions(self, node: Node) -> None:
        for child in node.named_children:
            self._expression(child)

    def _local_type(self, node: Node) -> None:
        self.types.append(node)

    def initializers(self, node: Node) -> None:
        """Read a constructor's initialiser list."""
        for child in node.named_children:
            if child.type == "field_initializer" and child.named_children:
                self._initializer(child)

    def _initializer(self, node: Node) -> None:
        target, *rest = node.named_children
        listed = rest[-1] if rest else None
        args = self.expr.arguments(listed)
        types = self.expr.template_arguments(target)
        name = Name(self.expr.name(target))
        value = args[0] if len(args) == 1 else Call(name, args, (), types, _line(target))
        if len(args) != 1 or "::" in name.id or name.id[:1].isupper():
            value = Call(name, args, (), types, _line(target))
        self._add("init", target, value, name)

    def _branch(self, node: Node) -> None:
        self._depth += 1
        if node.type == "for_range_loop":
            self._range(node)
        for child in node.named_children:
            if child.type in {"condition_clause", "parenthesized_expression"}:
                self._condition(child)
            elif child.type == "update_expression" and node.type == "for_statement":
                self._counter(child)
            else:
                self.read(child)
        self._depth -= 1

    def _range(self, node: Node) -> None:
        declarator, right = node.child_by_field_name("declarator"), node.child_by_field_name("right")
        if declarator is not None and right is not None:
            self._add("each", node, self.expr.read(right), Name(declared_name(self.expr, declarator)))

    def _macro_block(self, node: Node) -> None:
        """`BOOST_FOREACH(const T & item, list) { ... }` reads as a function; within a body none can stand."""
        if node.child_by_field_name("type") is not None:
            return
        self._depth += 1
        declarator, body = node.child_by_field_name("declarator"), node.child_by_field_name("body")
        loop = loop_macro(self.expr, declarator) if declarator is not None else None
        if loop is not None:
            self._add("each", node, loop[1], Name(declared_name(self.expr, loop[0])))
        if body is not None:
            self.read(body)
        self._depth -= 1

    def _counter(self, node: Node) -> None:
        """`++i` of a loop: from here on the counter is not the value that it starts with."""
        counter = node.child_by_field_name("argument")
        if counter is not None and counter.type == "identifier":
            name = self.expr.name(counter)
            self._add("each", node, Opaque(name), Name(name))

    def _condition(self, node: Node) -> None:
        value = node.child_by_field_name("value") or node
        if value.type == "declaration":
            self._bind(value, value)
            return
        read = self.expr.read(value)
        if matters(read):
            self._add("do", node, read)

    def _expression(self, node: Node) -> None:
        if node.type == "call_expression" and self.expr.data.startswith(_LOGGING_BYTES, node.start_byte):
            return
        counter = node.child_by_field_name("argument") if node.type == "update_expression" else None
        if counter is not None:
            self._counted(self.expr.read(counter))
            return
        self._effect(node, self.expr.read(node))

    def _effect(self, node: Node, value: Expr) -> None:
        """What an expression assigns, or that it calls something."""
        if isinstance(value, Op) and value.op == "=" and len(value.operands) == 2:
            target, assigned = value.operands
            if isinstance(assigned, Op) and assigned.op == "=":
                self._chained(node, value)
            elif not isinstance(assigned, Opaque):
                self._add("set", node, assigned, target)
        elif isinstance(value, Op) and value.op == "+=" and self._depth and isinstance(value.operands[1], Number):
            self._counted(value.operands[0])
        elif isinstance(value, Op) and value.op == "+=":
            self._add("set", node, Op("+", value.operands), value.operands[0])
        elif isinstance(value, Op) and value.op == "<<":
            self._stream(node, value)
        elif isinstance(value, Call) and (write := written(value)) is not None:
            self._add("set", node, write[1], write[0])
        elif has_call(value):
            self._add("do", node, value)

    def _counted(self, counter: Expr) -> None:
        """`index++;` in a loop: what the counter starts with is not what it is."""
        for at in range(len(self.statements) - 1, -1, -1) if self._depth else ():
            known = self.statements[at]
            if known.target == counter and isinstance(counter, Name) and isinstance(known.value, Number):
                self.statements[at] = replace(known, value=Opaque(counter.id))
                return

    def _chained(self, node: Node, value: Expr) -> None:
        """`a = b = c` gives `c` to both."""
        targets: list[Expr] = []
        while isinstance(value, Op) and value.op == "=" and len(value.operands) == 2:
            targets.append(value.operands[0])
            value = value.operands[1]
        if not isinstance(value, Opaque):
            for target in reversed(targets):
                self._add("set", node, value, target)

    def _stream(self, node: Node, value: Op) -> None:
        """`stream << a << b` appends to the stream."""
        parts = shifted(value)
        if isinstance(parts[0], Name) and "::" not in parts[0].id:
            self._add("set", node, Op("+", tuple(parts)), parts[0])
        elif has_call(value):
            self._add("do", node, value)

    def _return(self, node: Node) -> None:
        for child in node.named_children:
            value = self.expr.read(child)
            if not isinstance(value, Opaque):
                self._add("return", node, value)

    def _declaration(self, node: Node) -> None:
        kind = node.child_by_field_name("type")
        if kind is None:
            return
        for declarator in node.children_by_field_name("declarator"):
            self._bind(node, declarator)

    def _bind(self, declaration: Node, declarator: Node) -> None:
        kind = declaration.child_by_field_name("type")
        value = declarator.child_by_field_name("value")
        if kind is None:
            return
        if declarator.type == "function_declarator":
            self._constructed(kind, declarator)
            return
        bound = declarator.child_by_field_name("declarator") or declarator
        name = declared_name(self.expr, bound)
        if value is not None and value.type == "lambda_expression":
            self._named_lambda(name, value)
            return
        read = self._initial(kind, value)
        if kind.type == "primitive_type" and read is not None and not keeps_number(read):
            if matters(read):
                self._add("do", declarator, read)
            read = None
        mark = "" if kind.type == "placeholder_type_specifier" else _MARKS.get(bound.type, "")
        self._add("let", declarator, read, Name(name), self.expr.type_text(kind) + mark)

    def _constructed(self, kind: Node, declarator: Node) -> None:
        """`Listener listener(buffer);` reads as a function declaration; in a body it makes an object."""
        named, listed = (
            declarator.child_by_field_name("declarator"),
            declarator.child_by_field_name("parameters"),
        )
        if named is None or listed is None or named.type != "identifier" or not listed.named_children:
            return
        args = as_arguments(self.expr, listed)
        if args is None:
            return
        made = Call(Name(self.expr.name(kind)), args, (), self.expr.template_arguments(kind), _line(kind))
        self._add("let", declarator, made, Name(self.expr.text(named)), self.expr.type_text(kind))

    def _initial(self, kind: Node, value: Node | None) -> Expr | None:
        if value is None:
            return None
        if value.type not in {"argument_list", "initializer_list"}:
            return self.expr.read(value)
        args = self.expr.arguments(value)
        if value.type == "initializer_list" and kind.type == "placeholder_type_specifier":
            return Items(args)
        return Call(Name(self.expr.name(kind)), args, (), self.expr.template_arguments(kind), _line(kind))

    def _named_lambda(self, name: str, node: Node) -> None:
        body = node.child_by_field_name("body")
        declarator = node.child_by_field_name("declarator")
        listed = declarator.child_by_field_name("parameters") if declarator is not None else None
        inner = BodyReader(self.expr.data, f"{self.scope}::{name}")
        inner._nesting = self._nesting
        if body is not None:
            inner.read(body)
        params = parameters(self.expr, listed)
        self.functions.append(
            Function(
                name,
                self.scope,
                params,
                "",
                _line(node),
                node.end_point[0] + 1,
                tuple(inner.statements),
                traits=("lambda",),
            )
        )
        self.functions.extend(inner.functions)
        self._add("let", node, Lambda(lambda_types(self.expr, node)), Name(name), "auto")

    def _lambda_body(self, body: Node) -> None:
        self._depth += 1
        self._lambdas += 1
        self.read(body)
        self._lambdas -= 1
        self._depth -= 1

    def _add(
        self,
        kind: StatementKind,
        node: Node,
        value: Expr | None,
        target: Expr | None = None,
        declared: str = "",
    ) -> None:
        self.statements.append(Statement(kind, _line(node), value, target, declared, self._depth, self._lambdas > 0))


_LOGGING_BYTES = tuple(prefix.encode() for prefix in _LOGGING)


def _line(node: Node) -> int:
    row: int = node.start_point[0]
    return row + 1


_STEPS: dict[str, Callable[[BodyReader, Node], None]] = {
    "expression_statement": BodyReader._expressions,
    "declaration": BodyReader._declaration,
    "alias_declaration": BodyReader._local_type,
    "type_definition": BodyReader._local_type,
    "return_statement": BodyReader._return,
    "co_return_statement": BodyReader._return,
    "function_definition": BodyReader._macro_block,
}
