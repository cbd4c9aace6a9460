"""Where the statements of one C++ body are written down while it is read, in source order."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_invoking import with_copies
from ecm_parsers.source.expr import MOVED, Call, Expr, Items, Name
from ecm_parsers.source.facts import Statement, StatementKind
from ecm_parsers.source.flow import Block, FlowWriter, Later, Step

if TYPE_CHECKING:
    from tree_sitter import Node


class StatementWriter:
    """Collects statements, how they follow each other, and how deep they stand.

    Attributes:
        statements: what was written so far, in source order.
        depth: how many branches, loops and handlers stand around what is read now.
        declared: the variables that were declared so far.
        lambdas: how many anonymous lambdas stand around it.
        moved: variables that the statement at hand moves from, which it leaves without a value ([lib.types.movedfrom]).
        invoked: what it makes somebody call.
    """

    def __init__(self) -> None:
        self.moved: list[Name] = []
        self.invoked: list[Call] = []
        self.statements: list[Statement] = []
        self.depth = 0
        self.lambdas = 0
        self.declared: set[str] = set()
        self._flow = FlowWriter()

    def add(
        self,
        kind: StatementKind,
        node: Node,
        value: Expr | None,
        target: Expr | None = None,
        declared: str = "",
        kept: bool = False,
    ) -> None:
        """Add a statement that runs after those of the block at hand."""
        self.step(len(self.statements))
        later = self.lambdas > 0
        if kind in {"let", "each"}:
            self.declared.update(_names(target))
        self.statements.append(Statement(kind, line_of(node), value, target, declared, self.depth, later, kept))
        left = [each for each in dict.fromkeys(self.moved) if each != target and kind != "return"]
        self.moved.clear()
        invoked = self.invoked[:]
        self.invoked.clear()
        for call in invoked:
            self._add_later(node, call)
        for each in left:
            self.add("set", node, MOVED, each)

    def _add_later(self, node: Node, call: Call) -> None:
        """Add a call that runs any time from now on, with copies of variables as they are now."""
        call, copies = with_copies(call, f"<call {len(self.statements)}>")
        for name, copied in copies.items():
            self.add("let", node, copied, Name(name), "auto")
        self.begin()
        self.lambdas += 1
        self.add("do", node, call)
        self.lambdas -= 1
        self.step(Later(self.end()))

    def apart(self, node: Node, value: Expr, target: Expr, declared: str = "") -> int:
        """Add what a loop binds in each round, which is a step of that loop, and return its index."""
        self.begin()
        self.add("each", node, value, target, declared)
        self.end()
        return len(self.statements) - 1

    def assigned_since(self, before: int) -> Block:
        """Return the assignments among the statements from an index on."""
        since = range(before, len(self.statements))
        return tuple([at for at in since if self.statements[at].kind == "set" or _is_kept_value(self.statements[at])])

    def step(self, step: Step) -> None:
        """Add a step to the block at hand."""
        self._flow.add(step)

    def begin(self) -> None:
        """Begin a block within the one at hand."""
        self._flow.begin()

    def end(self) -> Block:
        """End the block at hand and return its steps."""
        return self._flow.end()

    def flow(self) -> Block:
        """Return the steps of the body; nothing where its statements simply follow each other."""
        return self._flow.flow()


def line_of(node: Node) -> int:
    """Return the line that a node begins on, from 1."""
    row: int = node.start_point[0]
    return row + 1


def otherwise(node: Node) -> Node | None:
    """Return what an `else` leads to."""
    clause = node.child_by_field_name("alternative")
    if clause is None or clause.type != "else_clause":
        return clause
    return next((child for child in clause.named_children if child.type != "comment"), None)


def _names(target: Expr | None) -> Iterator[str]:
    targets = target.items if isinstance(target, Items) else (target,)
    return (each.id for each in targets if isinstance(each, Name))


def _is_kept_value(statement: Statement) -> bool:
    """Tell whether a statement keeps what an expression gets of a variable that it changes."""
    return isinstance(statement.target, Name) and statement.target.id.startswith("#")
