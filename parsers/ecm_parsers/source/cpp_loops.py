"""Loops of C++ bodies: written as such, by macros, and by algorithms that call a lambda once for each element."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from ecm_parsers.source.cpp_algorithms import Rounds
from ecm_parsers.source.cpp_assigning import Assigning
from ecm_parsers.source.cpp_binding import Binding
from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_parameters import declared_name
from ecm_parsers.source.cpp_statements import StatementWriter, line_of
from ecm_parsers.source.cpp_vexing import loop_macro
from ecm_parsers.source.expr import Call, Constant, Expr, Items, Member, Name
from ecm_parsers.source.flow import Block, Branch, Leave, Loop

if TYPE_CHECKING:
    from tree_sitter import Node

_TRUE = Constant("true")


class Bodies(Protocol):
    """Who reads the statements of a body."""

    writer: StatementWriter
    expr: ExprReader

    def read(self, node: Node) -> None:
        """Read one statement, or a block of them."""

    def inner(self, *nodes: Node | None, deeper: int = 1) -> Block:
        """Read statements as a block of their own and return their flow."""

    def condition(self, node: Node | None) -> Expr:
        """Return a condition; what it declares, assigns or calls is a step of its own."""


class Loops:
    """Writes loops.

    Attributes:
        body: reads what they run. assigning, binding: read what they begin with.
        round: the algorithm whose lambda is read; None in none, and in functions that stand in one.
    """

    def __init__(self, body: Bodies, assigning: Assigning, binding: Binding) -> None:
        self.body = body
        self.assigning = assigning
        self.binding = binding
        self.round: Rounds | None = None

    def repeated(self, node: Node) -> None:
        """`while (test) { ... }`, `do { ... } while (test);`."""
        asked, first = node.child_by_field_name("condition"), node.type == "do_statement"
        self.body.writer.depth += 1
        test, again = (None, ()) if first else self._asked_again(asked)
        body = self.body.inner(node.child_by_field_name("body"), deeper=0)
        if first:
            self.body.writer.begin()
            test, again = self.body.condition(asked), self.body.writer.end()
        self.body.writer.depth -= 1
        self.body.writer.step(Loop(-1, test, body, again, first=first))

    def _asked_again(self, asked: Node | None) -> tuple[Expr, Block]:
        """Return the condition of a loop, and what it assigns each time that it is asked."""
        before = len(self.body.writer.statements)
        test = self.body.condition(asked)
        return test, self.body.writer.assigned_since(before)

    def counted(self, node: Node) -> None:
        """`for (int i = 0; i < n; i++) { ... }`."""
        self.body.writer.depth += 1
        start, update = node.child_by_field_name("initializer"), node.child_by_field_name("update")
        if start is not None:
            self.body.read(start) if start.type == "declaration" else self.assigning.expression(start)
        asked = node.child_by_field_name("condition")
        test, again = self._asked_again(asked) if asked is not None else (None, ())
        body = self.body.inner(node.child_by_field_name("body"), deeper=0)
        self.body.writer.begin()
        if update is not None:
            self.assigning.expression(update)
        self.body.writer.depth -= 1
        self.body.writer.step(Loop(-1, test, body, (*self.body.writer.end(), *again)))

    def over(self, node: Node) -> None:
        """`for (auto & item : list) { ... }`."""
        self.body.writer.depth += 1
        declarator, over = node.child_by_field_name("declarator"), node.child_by_field_name("right")
        each = self.binding.each(node, over, declarator) if declarator is not None and over is not None else -1
        body = self.body.inner(node.child_by_field_name("body"), deeper=0)
        self.body.writer.depth -= 1
        self.body.writer.step(Loop(each, None, body))

    def by_macro(self, node: Node) -> None:
        """`BOOST_FOREACH(const T & item, list) { ... }` reads as a function; within a body none can stand."""
        if node.child_by_field_name("type") is not None:
            return
        self.body.writer.depth += 1
        declarator, body = node.child_by_field_name("declarator"), node.child_by_field_name("body")
        loop = loop_macro(self.body.expr, declarator) if declarator is not None else None
        each = -1
        if loop is not None:
            each = self.body.writer.apart(node, loop[1], Name(declared_name(self.body.expr, loop[0])))
        self.body.writer.step(Loop(each, None, self.body.inner(body, deeper=0)))
        self.body.writer.depth -= 1

    def of_algorithm(self, node: Node, rounds: Rounds) -> None:
        """A loop with a scope of its own, in which a return ends the round."""
        around, self.round = self.round, rounds
        self.body.writer.begin()
        self.body.writer.depth += 1
        each = self.body.writer.apart(node, rounds.over, Name(rounds.each.name), rounds.each.type)
        self.body.writer.step(Loop(each, None, (Branch(_TRUE, self.body.inner(rounds.body, deeper=0)),)))
        self.body.writer.depth -= 1
        self.body.writer.step(Branch(_TRUE, self.body.writer.end()))
        self.round = around

    def result(self, node: Node, rounds: Rounds) -> None:
        """Read a return in a round, which it ends: what it gives is put where the algorithm puts it."""
        given = self.body.expr.arguments(node)
        put = Member(rounds.into, "push_back") if rounds.into is not None else None
        added: Expr = Call(put, given, (), (), line_of(node)) if put is not None else Items(given)
        self.assigning.effect(node, added)
        self.body.writer.step(Leave("continue"))
