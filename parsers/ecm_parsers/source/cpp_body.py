"""Statements of a C++ function body, and which of them run when: one method for each kind of statement."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, NamedTuple

from ecm_parsers.source.cpp_algorithms import rounds_of
from ecm_parsers.source.cpp_assigning import Assigning
from ecm_parsers.source.cpp_binding import Binding
from ecm_parsers.source.cpp_brought import Brought, is_directive, names_used
from ecm_parsers.source.cpp_captures import Captures, capturing
from ecm_parsers.source.cpp_cases import CaseNodes, cases_of
from ecm_parsers.source.cpp_changes import Changes
from ecm_parsers.source.cpp_effects import matters
from ecm_parsers.source.cpp_expr import ExprReader, lambda_types
from ecm_parsers.source.cpp_heads import LastNamed, hides, macro_test
from ecm_parsers.source.cpp_lambdas import DeclaredFunctions, as_function, lambda_parameters, lambda_traits, place_name
from ecm_parsers.source.cpp_loops import Loops
from ecm_parsers.source.cpp_members import CLASSES
from ecm_parsers.source.cpp_parameters import declared_name
from ecm_parsers.source.cpp_raising import type_thrown, types_caught
from ecm_parsers.source.cpp_statements import StatementWriter, line_of, otherwise
from ecm_parsers.source.expr import Constant, Expr, Lambda, Name, Op, Opaque
from ecm_parsers.source.facts import Function
from ecm_parsers.source.flow import Attempt, Block, Branch, Case, Handler, Later, Leave, Switch

if TYPE_CHECKING:
    from tree_sitter import Node

MAX_NESTING = 200
RETURNED = "<returned>"
"""Name of a lambda that a function returns."""
_BLOCKS = frozenset({"compound_statement", "else_clause", "case_statement", "labeled_statement", "ERROR"}) | {
    "attributed_statement"
}
_TRUE = Constant("true")


class LocalName(NamedTuple):
    """What is declared within a function for its own use, and the scope of that: a class, another way to name one."""

    node: Node
    scope: str


class BodyReader:
    """Collects the statements of one function, those of its anonymous lambdas included.

    Attributes:
        writer: what was read so far, in source order, and how it follows each other.
        functions: lambdas that are read as functions of their own.
        declared: the functions of the file.
        local_names: classes, `using A = B`, `using namespace a` and the like, those of lambdas included; whoever
            reads declarations reads them.
    """

    def __init__(self, data: bytes, scope: str, declared: DeclaredFunctions) -> None:
        self.writer = StatementWriter()
        within = Changes(self.writer).within
        self.expr = ExprReader(data, self._lambda_body, self._called_lambda, self._handed_lambda, within)
        self.expr.moved, self.expr.invoked = self.writer.moved, self.writer.invoked
        self.scope = scope
        self.declared = declared
        self.functions: list[Function] = []
        self.local_names: list[LocalName] = []
        self._binding = Binding(self.expr, self.writer, self._named_lambda)
        self._assigning = Assigning(self.expr, self.writer, self._binding.buffers)
        self._loops = Loops(self, self._assigning, self._binding)
        self._captures = Captures()
        self._last = LastNamed(data)
        self._nesting = 0
        self._entering = False

    def read(self, node: Node) -> None:
        """Read one statement, or a block of them."""
        if self._nesting >= MAX_NESTING:
            return
        if not self._nesting:
            self._last.begin(node)
        self._nesting += 1
        if node.type == "compound_statement" and self._nesting > 1 and not self._entering:
            self.writer.step(Branch(_TRUE, self.inner(node, deeper=0)))
        elif node.type in _BLOCKS:
            self._entering = False
            for child in node.named_children:
                self.read(child)
        elif (step := _STEPS.get(node.type)) is not None:
            hiding = hides(self.expr, node, self.writer.declared, self._last)
            if hiding:
                self.writer.begin()
            step(self, node)
            if hiding:
                self.writer.step(Branch(_TRUE, self.writer.end()))
        self._nesting -= 1

    def _expressions(self, node: Node) -> None:
        for child in node.named_children:
            rounds = rounds_of(self.expr, child)
            if rounds is not None:
                self._loops.of_algorithm(child, rounds)
            else:
                self._assigning.expression(child)

    def _local_name(self, node: Node) -> None:
        self.local_names.append(LocalName(node, self.scope))
        if node.type == "using_declaration" and not is_directive(node):
            for whole in (name for name in names_used(self.expr, node) if "::" in name):
                self.expr.brought.take(whole)

    def initializers(self, node: Node) -> None:
        """Read a constructor's initialiser list."""
        for child in node.named_children:
            if child.type == "field_initializer" and child.named_children:
                self._binding.initializer(child)

    def inner(self, *nodes: Node | None, deeper: int = 1) -> Block:
        """Read statements as a block of their own and return their flow."""
        self.writer.begin()
        self.writer.depth += deeper
        with self.expr.brought.block():
            for node in nodes:
                if node is not None:
                    self._entering = node.type == "compound_statement"
                    self.read(node)
        self._entering = False
        self.writer.depth -= deeper
        return self.writer.end()

    def _if(self, node: Node) -> None:
        """A condition with its block; `else if` makes it a choice among conditions, of which the first one holds."""
        self.writer.depth += 1
        cases, other = [self._tested(node)], otherwise(node)
        while other is not None and other.type == "if_statement":
            cases.append(self._tested(other))
            other = otherwise(other)
        self.writer.depth -= 1
        rest = self.inner(other)
        if len(cases) == 1:
            self.writer.step(Branch(cases[0].tests[0], cases[0].body, rest))
        else:
            self.writer.step(Switch(_TRUE, (*cases, Case((), rest)), False))

    def _tested(self, node: Node) -> Case:
        """One condition with what runs when it holds."""
        test = self.condition(node.child_by_field_name("condition"))
        return Case((test,), self.inner(node.child_by_field_name("consequence"), deeper=0))

    def _preprocessed(self, node: Node) -> None:
        """`#if`: which side a build takes is not known here."""
        other = node.child_by_field_name("alternative")
        named = node.child_by_field_name("name") or node.child_by_field_name("condition")
        rest = [child for child in node.named_children if child not in (other, named)]
        test = macro_test(self.expr, node, named)
        then = self.inner(*rest, deeper=0)
        otherwise = self.inner(other, deeper=0)
        if node.type == "preproc_else":
            for step in then:
                self.writer.step(step)
        else:
            self.writer.step(Branch(test, then, otherwise))

    def _switch(self, node: Node) -> None:
        subject = self.condition(node.child_by_field_name("condition"))
        body = node.child_by_field_name("body")
        self.writer.depth += 1
        cases = [self._case(case) for case in cases_of(body)] if body is not None else []
        self.writer.depth -= 1
        self.writer.step(Switch(subject, tuple(cases), True))

    def _case(self, case: CaseNodes) -> Case:
        tests = (self.expr.read(case.value),) if case.value is not None else ()
        return Case(tests, self.inner(*case.statements, deeper=0))

    def _try(self, node: Node) -> None:
        clauses = [child for child in node.named_children if child.type == "catch_clause"]
        body = self.inner(node.child_by_field_name("body"))
        blocks = [self.inner(clause.child_by_field_name("body"), deeper=2) for clause in clauses]
        types = [types_caught(self.expr, clause) for clause in clauses]
        self.writer.step(Attempt(body, tuple(map(Handler, types, blocks))))

    def _throw(self, node: Node) -> None:
        self._expressions(node)
        self.writer.step(Leave("throw", type_thrown(self.expr, node)))

    def condition(self, node: Node | None) -> Expr:
        """Return a condition; what it declares, assigns or calls is a step of its own."""
        if node is None:
            return Opaque("")
        start = node.child_by_field_name("initializer")
        if start is not None:
            for child in start.named_children if start.type == "init_statement" else [start]:
                self.read(child)
        value = node.child_by_field_name("value") or node
        if value.type == "declaration":
            self._binding.bind(value, value)
            declarator = value.child_by_field_name("declarator")
            return Name(declared_name(self.expr, declarator)) if declarator is not None else Opaque("")
        read = self.expr.read(value)
        if isinstance(read, Op) and read.op == "=":
            self._assigning.effect(node, read)
            return read.operands[0]
        self._assigning.within(node, read)
        if matters(read):
            self.writer.add("do", node, read)
        return read

    def _return(self, node: Node) -> None:
        if self._loops.round is not None:
            self._loops.result(node, self._loops.round)
            return
        values = [child for child in node.named_children if child.type != "comment"]
        for child in values:
            if child.type == "lambda_expression":
                self._named_lambda(RETURNED, child)
                self.writer.add("return", node, Name(RETURNED))
            else:
                self.writer.add("return", node, self.expr.read(child))
        if not values:
            self.writer.step(Leave("return"))

    def _declaration(self, node: Node) -> None:
        kind = node.child_by_field_name("type")
        if kind is None:
            return
        if kind.type in CLASSES and kind.child_by_field_name("body") is not None:
            self.local_names.append(LocalName(kind, self.scope))
        for declarator in node.children_by_field_name("declarator"):
            self._binding.bind(node, declarator)

    def _called_lambda(self, node: Node) -> str:
        """Read a lambda that is called where it stands as a function of that place; return its name."""
        name = place_name(node)
        self._named_lambda(name, node)
        return name

    def _handed_lambda(self, node: Node) -> Lambda | None:
        """Read a lambda that is handed to a function of the file as a function of that place; None of others."""
        if self.writer.lambdas or not self.declared.get(node):
            return None
        return as_function(lambda_types(self.expr, node), self._lambda_function(place_name(node), node))

    def _named_lambda(self, name: str, node: Node) -> None:
        self._lambda_function(name, node)
        self.writer.add("let", node, Lambda(lambda_types(self.expr, node)), Name(name), "auto")

    def _lambda_function(self, name: str, node: Node) -> Function:
        body = node.child_by_field_name("body")
        held = self._held_captures(name, node)
        inner = BodyReader(self.expr.data, f"{self.scope}::{name}", self.declared)
        inner._nesting = self._nesting
        inner.expr.brought = Brought(self.expr.brought)
        given = lambda_parameters(self.expr, node)
        inner.expr.brought.hide(parameter.name for parameter in given)
        inner.writer.declared.update(parameter.name for parameter in given)
        if body is not None:
            inner.read(body)
        self.local_names += inner.local_names
        made = Function(
            name,
            self.scope,
            given,
            "",
            line_of(node),
            node.end_point[0] + 1,
            tuple(inner.writer.statements),
            traits=lambda_traits(node),
            flow=inner.writer.flow(),
        )
        read = capturing((made, *inner.functions), held)
        self.functions.extend(read)
        return read[0]

    def _held_captures(self, name: str, node: Node) -> Mapping[str, str]:
        """Declare what a lambda evaluates when it is made; return what its body calls that, by its own names."""
        found: dict[str, str] = {}
        for capture in self._captures.of(node):
            value = self.expr.read(capture.value)
            shared = capture.shares and isinstance(value, Name)
            held = value if shared and isinstance(value, Name) else Name(f"{name}::{capture.name}")
            found[capture.name] = held.id
            if not shared:
                self.writer.add("let", node, value, held, "auto")
        return found

    def _lambda_body(self, node: Node) -> None:
        given = [parameter.name for parameter in lambda_parameters(self.expr, node)]
        names = (*given, *self._captured(node))
        around, self._loops.round = self._loops.round, None
        self.writer.lambdas += 1
        with self.expr.brought.block(given):
            self.writer.step(Later(self.inner(node.child_by_field_name("body")), names))
        self.writer.lambdas -= 1
        self._loops.round = around

    def _captured(self, node: Node) -> list[str]:
        """Read what a lambda evaluates when it is made; return the names by which its body has that."""
        captures = self._captures.of(node)
        for capture in captures:
            self._assigning.expression(capture.value)
        return [capture.name for capture in captures]


_STEPS: dict[str, Callable[[BodyReader, Node], None]] = {
    "expression_statement": BodyReader._expressions,
    "declaration": BodyReader._declaration,
    "alias_declaration": BodyReader._local_name,
    "type_definition": BodyReader._local_name,
    "using_declaration": BodyReader._local_name,
    "class_specifier": BodyReader._local_name,
    "struct_specifier": BodyReader._local_name,
    "union_specifier": BodyReader._local_name,
    "namespace_alias_definition": BodyReader._local_name,
    "return_statement": BodyReader._return,
    "co_return_statement": BodyReader._return,
    "break_statement": lambda body, _: body.writer.step(Leave("break")),
    "goto_statement": lambda body, _: body.writer.step(Leave("goto")),
    "continue_statement": lambda body, _: body.writer.step(Leave("continue")),
    "throw_statement": BodyReader._throw,
    "if_statement": BodyReader._if,
    "while_statement": lambda body, node: body._loops.repeated(node),
    "do_statement": lambda body, node: body._loops.repeated(node),
    "for_statement": lambda body, node: body._loops.counted(node),
    "for_range_loop": lambda body, node: body._loops.over(node),
    "switch_statement": BodyReader._switch,
    "try_statement": BodyReader._try,
    "function_definition": lambda body, node: body._loops.by_macro(node),
    "preproc_if": BodyReader._preprocessed,
    "preproc_ifdef": BodyReader._preprocessed,
    "preproc_else": BodyReader._preprocessed,
    "preproc_elif": BodyReader._preprocessed,
    "preproc_elifdef": BodyReader._preprocessed,
}
