"""Statements of a C++ function body."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_effects import has_call, matters, shifted
from ecm_parsers.source.cpp_expr import ExprReader, lambda_types
from ecm_parsers.source.cpp_parameters import declared_name, parameters
from ecm_parsers.source.cpp_vexing import as_arguments, loop_macro
from ecm_parsers.source.cpp_writes import written
from ecm_parsers.source.expr import Call, Constant, Expr, Items, Lambda, Name, Number, Op, Opaque
from ecm_parsers.source.facts import Function, Statement, StatementKind
from ecm_parsers.source.flow import Attempt, Block, Branch, Case, FlowWriter, Later, Leave, Loop, Switch

if TYPE_CHECKING:
    from tree_sitter import Node

MAX_NESTING = 200
RETURNED = "<returned>"
"""Name of a lambda that a function returns."""
_BLOCKS = frozenset(
    {
        "compound_statement",
        "else_clause",
        "case_statement",
        "labeled_statement",
        "ERROR",
    }
)
_ASSIGNING = frozenset({"-=", "*=", "/=", "%=", "|=", "&=", "^=", "<<=", ">>="})
_TRUE = Constant("true")
_MARKS = {"pointer_declarator": " *", "reference_declarator": " &"}
_LOGGING = ("RCLCPP_", "ROS_", "RCUTILS_", "ASSERT_", "EXPECT_")


class BodyReader:
    """Collects the statements of one function, those of its anonymous lambdas included.

    Attributes:
        statements: what was read so far, in source order.
        flow: how they follow each other.
        functions: lambdas bound to a name, read as functions of their own.
        types: `using A = B` and typedefs, whoever reads declarations reads them.
    """

    def __init__(self, data: bytes, scope: str) -> None:
        self.expr = ExprReader(data, self._lambda_body)
        self.scope = scope
        self.statements: list[Statement] = []
        self.flow = FlowWriter()
        self.functions: list[Function] = []
        self.types: list[Node] = []
        self._depth = 0
        self._lambdas = 0
        self._nesting = 0
        self._entering = False

    def read(self, node: Node) -> None:
        """Read one statement, or a block of them."""
        if self._nesting >= MAX_NESTING:
            return
        self._nesting += 1
        kind = node.type
        if kind == "compound_statement" and self._nesting > 1 and not self._entering:
            self.flow.add(Branch(_TRUE, self._inner(node, deeper=0)))
        elif kind in _BLOCKS:
            self._entering = False
            for child in node.named_children:
                self.read(child)
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

    def _inner(self, *nodes: Node | None, deeper: int = 1) -> Block:
        """Read statements as a block of their own and return their flow."""
        self.flow.begin()
        self._depth += deeper
        for node in nodes:
            if node is not None:
                self._entering = node.type == "compound_statement"
                self.read(node)
        self._entering = False
        self._depth -= deeper
        return self.flow.end()

    def _if(self, node: Node) -> None:
        """A condition with its block; `else if` makes it a choice among conditions, of which the first one holds."""
        self._depth += 1
        cases, other = [self._tested(node)], _otherwise(node)
        while other is not None and other.type == "if_statement":
            cases.append(self._tested(other))
            other = _otherwise(other)
        self._depth -= 1
        rest = self._inner(other)
        if len(cases) == 1:
            self.flow.add(Branch(cases[0].tests[0], cases[0].body, rest))
        else:
            self.flow.add(Switch(_TRUE, (*cases, Case((), rest)), False))

    def _tested(self, node: Node) -> Case:
        """One condition with what runs when it holds."""
        test = self._condition(node.child_by_field_name("condition"))
        return Case((test,), self._inner(node.child_by_field_name("consequence"), deeper=0))

    def _while(self, node: Node) -> None:
        self._depth += 1
        if node.type == "do_statement":
            body = self._inner(node.child_by_field_name("body"), deeper=0)
            test, again = self._asked_again(node)
        else:
            test, again = self._asked_again(node)
            body = self._inner(node.child_by_field_name("body"), deeper=0)
        self._depth -= 1
        self.flow.add(Loop(-1, test, body, again, first=node.type == "do_statement"))

    def _asked_again(self, node: Node) -> tuple[Expr, Block]:
        """Return the condition of a loop, and what it assigns each time that it is asked."""
        before = len(self.statements)
        test = self._condition(node.child_by_field_name("condition"))
        asked = range(before, len(self.statements))
        return test, tuple([at for at in asked if self.statements[at].kind == "set"])

    def _for(self, node: Node) -> None:
        self._depth += 1
        start, update = node.child_by_field_name("initializer"), node.child_by_field_name("update")
        if start is not None:
            self.read(start) if start.type == "declaration" else self._expression(start)
        asked = node.child_by_field_name("condition")
        test = self._condition(asked) if asked is not None else None
        body = self._inner(node.child_by_field_name("body"), deeper=0)
        self.flow.begin()
        if update is not None:
            self._expression(update)
        self._depth -= 1
        self.flow.add(Loop(-1, test, body, self.flow.end()))

    def _for_each(self, node: Node) -> None:
        self._depth += 1
        kind = node.child_by_field_name("type")
        declarator, right = node.child_by_field_name("declarator"), node.child_by_field_name("right")
        each = -1
        if declarator is not None and right is not None:
            value = self.expr.read(right)
            mark = _MARKS.get(declarator.type, "")
            written = self._written(node, kind, declarator) + mark if kind is not None else ""
            each = self._looped(node, value, self._bound(declarator), written)
        body = self._inner(node.child_by_field_name("body"), deeper=0)
        self._depth -= 1
        self.flow.add(Loop(each, None, body))

    def _looped(self, node: Node, value: Expr, target: Expr, declared: str = "") -> int:
        """Emit what a loop binds; its step belongs to the loop."""
        self.flow.begin()
        self._add("each", node, value, target, declared)
        self.flow.end()
        return len(self.statements) - 1

    def _written(self, node: Node, kind: Node, declarator: Node) -> str:
        """A declared type with its qualifiers."""
        first = next((child for child in node.children if child.type == "type_qualifier"), kind)
        text = self.expr.data[min(first.start_byte, kind.start_byte) : declarator.start_byte]
        return " ".join(text.decode("utf-8", "replace").split())

    def _bound(self, declarator: Node) -> Expr:
        """What a declarator binds: a name, or several of a structured binding."""
        while declarator.type == "reference_declarator" and declarator.named_children:
            declarator = declarator.named_children[0]
        if declarator.type == "structured_binding_declarator":
            return Items(tuple([Name(self.expr.text(child)) for child in declarator.named_children]))
        return Name(declared_name(self.expr, declarator))

    def _preprocessed(self, node: Node) -> None:
        """`#if`: which side a build takes is not known here."""
        other = node.child_by_field_name("alternative")
        named = node.child_by_field_name("name") or node.child_by_field_name("condition")
        rest = [child for child in node.named_children if child not in (other, named)]
        test = self._macro_test(node, named)
        then = self._inner(*rest, deeper=0)
        otherwise = self._inner(other, deeper=0)
        if node.type == "preproc_else":
            for step in then:
                self.flow.add(step)
        else:
            self.flow.add(Branch(test, then, otherwise))

    def _macro_test(self, node: Node, named: Node | None) -> Expr:
        """What a directive asks: `#if ` and the macro, or the condition as written."""
        test = Opaque(f"#if {self.expr.text(named)[:80] if named is not None else 'else'}")
        first = node.children[0].type if node.children else ""
        return Op("!", (test,)) if first.endswith("ifndef") else test

    def _switch(self, node: Node) -> None:
        subject = self._condition(node.child_by_field_name("condition"))
        body = node.child_by_field_name("body")
        self._depth += 1
        cases = [self._case(child) for child in body.named_children] if body is not None else []
        self._depth -= 1
        self.flow.add(Switch(subject, tuple([case for case in cases if case is not None]), True))

    def _case(self, node: Node) -> Case | None:
        if node.type != "case_statement":
            return None
        value = node.child_by_field_name("value")
        rest = [child for child in node.named_children if child != value]
        tests = (self.expr.read(value),) if value is not None else ()
        return Case(tests, self._inner(*rest, deeper=0))

    def _try(self, node: Node) -> None:
        handlers = [child for child in node.named_children if child.type == "catch_clause"]
        body = self._inner(node.child_by_field_name("body"))
        caught = tuple([self._inner(child.child_by_field_name("body"), deeper=2) for child in handlers])
        self.flow.add(Attempt(body, caught))

    def _break(self, _: Node) -> None:
        self.flow.add(Leave("break"))

    def _continue(self, _: Node) -> None:
        self.flow.add(Leave("continue"))

    def _throw(self, node: Node) -> None:
        self._expressions(node)
        self.flow.add(Leave("throw"))

    def _macro_block(self, node: Node) -> None:
        """`BOOST_FOREACH(const T & item, list) { ... }` reads as a function; within a body none can stand."""
        if node.child_by_field_name("type") is not None:
            return
        self._depth += 1
        declarator, body = node.child_by_field_name("declarator"), node.child_by_field_name("body")
        loop = loop_macro(self.expr, declarator) if declarator is not None else None
        each = -1
        if loop is not None:
            each = self._looped(node, loop[1], Name(declared_name(self.expr, loop[0])))
        self.flow.add(Loop(each, None, self._inner(body, deeper=0)))
        self._depth -= 1

    def _condition(self, node: Node | None) -> Expr:
        """Return a condition; what it declares, assigns or calls is a step of its own."""
        if node is None:
            return Opaque("")
        start = node.child_by_field_name("initializer")
        if start is not None:
            for child in start.named_children if start.type == "init_statement" else [start]:
                self.read(child)
        value = node.child_by_field_name("value") or node
        if value.type == "declaration":
            self._bind(value, value)
            declarator = value.child_by_field_name("declarator")
            return Name(declared_name(self.expr, declarator)) if declarator is not None else Opaque("")
        read = self.expr.read(value)
        if isinstance(read, Op) and read.op == "=":
            self._effect(node, read)
            return read.operands[0]
        self._assigned_within(node, read)
        if matters(read):
            self._add("do", node, read)
        return read

    def _assigned_within(self, node: Node, value: Expr) -> None:
        """`while (stream >> name)` and `if ((n = next()) > 0)` change variables before they are decided."""
        if not isinstance(value, Op):
            return
        if value.op in {">>", "="}:
            self._effect(node, value)
            return
        for operand in value.operands:
            self._assigned_within(node, operand)

    def _expression(self, node: Node) -> None:
        if node.type == "call_expression" and self.expr.data.startswith(_LOGGING_BYTES, node.start_byte):
            return
        if node.type == "comma_expression":
            for child in node.named_children:
                self._expression(child)
            return
        counter = node.child_by_field_name("argument") if node.type == "update_expression" else None
        if counter is not None:
            self._counted(node, self.expr.read(counter))
            return
        self._effect(node, self.expr.read(node))

    def _effect(self, node: Node, value: Expr) -> None:
        """What an expression assigns, or that it calls something."""
        if isinstance(value, Op) and value.op == "=" and len(value.operands) == 2:
            target, assigned = value.operands
            if isinstance(assigned, Op) and assigned.op == "=":
                self._chained(node, value)
            else:
                self._add("set", node, assigned, target)
        elif isinstance(value, Op) and value.op == "+=":
            self._add("set", node, Op("+", value.operands), value.operands[0])
        elif isinstance(value, Op) and value.op in _ASSIGNING:
            self._add("set", node, Op(value.op[:-1], value.operands), value.operands[0])
        elif isinstance(value, Op) and value.op == "<<":
            self._stream(node, value)
        elif isinstance(value, Op) and value.op == ">>":
            self._streamed_out(node, value)
        elif isinstance(value, Call) and (write := written(value)) is not None:
            self._add("set", node, write[1], write[0])
        elif has_call(value):
            self._add("do", node, value)

    def _counted(self, node: Node, counter: Expr) -> None:
        """What `++index;` and `index--;` give the index."""
        operator = node.child_by_field_name("operator")
        sign = "+" if operator is not None and operator.type == "++" else "-"
        self._add("set", node, Op(sign, (counter, Number(1))), counter)

    def _streamed_out(self, node: Node, value: Op) -> None:
        """`stream >> a >> b` writes what nobody knows."""
        left: Expr = value
        while isinstance(left, Op) and left.op == ">>" and len(left.operands) == 2:
            self._add("set", node, Opaque(">>"), left.operands[1])
            left = left.operands[0]

    def _chained(self, node: Node, value: Expr) -> None:
        """`a = b = c` gives `c` to both."""
        targets: list[Expr] = []
        while isinstance(value, Op) and value.op == "=" and len(value.operands) == 2:
            targets.append(value.operands[0])
            value = value.operands[1]
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
        values = [child for child in node.named_children if child.type != "comment"]
        for child in values:
            if child.type == "lambda_expression":
                self._named_lambda(RETURNED, child)
                self._add("return", node, Name(RETURNED))
            else:
                self._add("return", node, self.expr.read(child))
        if not values:
            self.flow.add(Leave("return"))

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
        target = self._bound(bound)
        if isinstance(target, Items):
            self._add("let", declarator, self._initial(kind, value), target, self.expr.type_text(kind))
            return
        name = declared_name(self.expr, bound)
        if value is not None and value.type == "lambda_expression":
            self._named_lambda(name, value)
            return
        read = self._initial(kind, value)
        qualifier = _qualifier(self.expr, declaration)
        written = qualifier + self.expr.type_text(kind) + _MARKS.get(bound.type, "")
        kept = not qualifier and _is_static(self.expr, declaration)
        self._add("let", declarator, read, Name(name), written, kept)

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
                traits=("lambda", "mutable") if _is_mutable(node) else ("lambda",),
                flow=inner.flow.flow(),
            )
        )
        self.functions.extend(inner.functions)
        self._add("let", node, Lambda(lambda_types(self.expr, node)), Name(name), "auto")

    def _lambda_body(self, node: Node) -> None:
        declarator = node.child_by_field_name("declarator")
        listed = declarator.child_by_field_name("parameters") if declarator is not None else None
        names = tuple([parameter.name for parameter in parameters(self.expr, listed)])
        self._lambdas += 1
        self.flow.add(Later(self._inner(node.child_by_field_name("body")), names))
        self._lambdas -= 1

    def _add(
        self,
        kind: StatementKind,
        node: Node,
        value: Expr | None,
        target: Expr | None = None,
        declared: str = "",
        kept: bool = False,
    ) -> None:
        self.flow.add(len(self.statements))
        later = self._lambdas > 0
        self.statements.append(Statement(kind, _line(node), value, target, declared, self._depth, later, kept))


_LOGGING_BYTES = tuple(prefix.encode() for prefix in _LOGGING)


def _line(node: Node) -> int:
    row: int = node.start_point[0]
    return row + 1


def _qualifier(reader: ExprReader, declaration: Node) -> str:
    """`const` where a declaration has it."""
    words = [reader.text(child) for child in declaration.children if child.type == "type_qualifier"]
    return "const " if {"const", "constexpr"} & set(words) else ""


def _is_static(reader: ExprReader, declaration: Node) -> bool:
    """Whether a variable of a function keeps what it holds until the next call."""
    specifiers = (child for child in declaration.children if child.type == "storage_class_specifier")
    return any(reader.text(child) == "static" for child in specifiers)


def _otherwise(node: Node) -> Node | None:
    """What an `else` leads to."""
    clause = node.child_by_field_name("alternative")
    if clause is None or clause.type != "else_clause":
        return clause
    return next((child for child in clause.named_children if child.type != "comment"), None)


_STEPS: dict[str, Callable[[BodyReader, Node], None]] = {
    "expression_statement": BodyReader._expressions,
    "declaration": BodyReader._declaration,
    "alias_declaration": BodyReader._local_type,
    "type_definition": BodyReader._local_type,
    "return_statement": BodyReader._return,
    "co_return_statement": BodyReader._return,
    "break_statement": BodyReader._break,
    "continue_statement": BodyReader._continue,
    "throw_statement": BodyReader._throw,
    "if_statement": BodyReader._if,
    "while_statement": BodyReader._while,
    "do_statement": BodyReader._while,
    "for_statement": BodyReader._for,
    "for_range_loop": BodyReader._for_each,
    "switch_statement": BodyReader._switch,
    "try_statement": BodyReader._try,
    "function_definition": BodyReader._macro_block,
    "preproc_if": BodyReader._preprocessed,
    "preproc_ifdef": BodyReader._preprocessed,
    "preproc_else": BodyReader._preprocessed,
    "preproc_elif": BodyReader._preprocessed,
    "preproc_elifdef": BodyReader._preprocessed,
}


def _is_mutable(node: Node) -> bool:
    """Whether a lambda may change its own copies of what it captures."""
    declarator = node.child_by_field_name("declarator")
    parts = declarator.children if declarator is not None else []
    return any(part.text == b"mutable" for part in parts)
