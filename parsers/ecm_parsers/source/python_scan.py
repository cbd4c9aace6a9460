"""The walk over a Python syntax tree: what is being read, where its facts go, and the bounds of the walk.

What a node means is told by two tables of handlers by node type, one for expressions and one for statements.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal, TypeAlias

from tree_sitter import Node

from ecm_parsers.source.expr import THIS, Expr, Member, Name, Number, Op, Opaque, Text
from ecm_parsers.source.facts import Class, Constant, Field, Function, Import, Statement, StatementKind
from ecm_parsers.source.flow import Block, FlowWriter
from ecm_parsers.source.python_private import is_private

MAX_EXPRESSION_DEPTH = 80
MAX_BLOCK_DEPTH = 40
OPAQUE_LENGTH = 80
# Longer chains are read node by node, so that no text is looked at once per link.
MAX_DOTTED_LENGTH = 120

_LEAVES = frozenset(("identifier", "attribute", "string", "integer", "float", "true", "false", "none"))
# What may stand between any two nodes.
EXTRAS = frozenset(("comment", "line_continuation"))
SKIPPED = EXTRAS | {"ERROR"}
"""Nodes that say nothing: comments, and what could not be parsed."""
_LITERALS = (Text, Number)

Place: TypeAlias = Literal["module", "class", "function"]


class Frame:
    """The body being read: of the module, a class or a function.

    Attributes:
        place: what it is the body of.
        scope: scope of what is declared in it.
        body: statements; a class body runs as part of the body that declares the class. flow: how they follow.
        shared: names that are declared `global` or `nonlocal`; globals: those of the module.
        names: expressions of names and dotted names seen, by source bytes; maps the receiver to `this`.
        fields: of the class being read, also in its `__init__`; None elsewhere.
        owner: the class as an expression, in a class body. bases: its bases as written, also in its methods.
        depth: how many conditions and loops enclose the current statement. begun: its body. lambdas: how many do.
            attempts: how many `try`. yields: how many `yield`, whose answers all but `unanswered` use.
    """

    __slots__ = (
        "attempts",
        "bases",
        "begun",
        "body",
        "depth",
        "fields",
        "flow",
        "globals",
        "lambdas",
        "names",
        "owner",
        "place",
        "scope",
        "shared",
        "unanswered",
        "yields",
    )

    def __init__(
        self,
        place: Place,
        scope: str,
        body: list[Statement],
        names: dict[bytes, Expr],
        flow: FlowWriter | None = None,
    ) -> None:
        self.place = place
        self.scope = scope
        self.body = body
        self.flow = flow or FlowWriter()
        self.shared: list[str] = []
        self.globals: list[Constant] = []
        self.names = names
        self.fields: list[Field] | None = None
        self.owner: Expr | None = None
        self.bases: tuple[str, ...] = ()
        self.depth = self.begun = 0
        self.lambdas = 0
        self.attempts = 0
        self.yields = 0
        self.unanswered = 0


class Scan:
    """Facts of one file while it is walked."""

    def __init__(
        self, data: bytes, expressions: Mapping[str, ExprHandler], statements: Mapping[str, StatementHandler]
    ) -> None:
        self.data = data
        self.expressions = expressions
        self.statements = statements
        self.imports: list[Import] = []
        self.classes: list[Class] = []
        self.functions: list[Function] = []
        self.constants: list[Constant] = []
        self.frame = Frame("module", "", [], {})
        self._receivers: dict[bytes, dict[bytes, Expr]] = {}
        self.calls = 0
        self.has_private = False
        self.cut_line = 0
        self._level = 0
        self._nesting = 0

    def expr(self, node: Node) -> Expr:
        """Read an expression; what has no counterpart, or is nested too deeply, is Opaque."""
        kind = node.type
        if kind in _LEAVES:
            # The same bytes mean the same in one frame, and most names and literals come up again.
            raw = self.data[node.start_byte : node.end_byte]
            found = self.frame.names.get(raw)
            return found if found is not None else self._leaf(kind, node, raw)
        return self._compound(kind, node)

    def _leaf(self, kind: str, node: Node, raw: bytes) -> Expr:
        if kind == "identifier":
            return self.name(raw)
        value = self._compound(kind, node)
        if isinstance(value, _LITERALS):
            self.frame.names[raw] = value
        return value

    def _compound(self, kind: str, node: Node) -> Expr:
        handler = self.expressions.get(kind)
        if handler is None:
            return self.opaque(node)
        if self._level >= MAX_EXPRESSION_DEPTH:
            return self.cut(node)
        self._level += 1
        value = handler(self, node)
        self._level -= 1
        return value

    def name(self, raw: bytes) -> Expr:
        """Expression of a name or a dotted name, the same object each time; the receiver is `this`."""
        names = self.frame.names
        found = names.get(raw)
        if found is None:
            base, dot, last = raw.rpartition(b".")
            text = self.noted(last.decode("utf-8", "replace"))
            found = Member(self.name(base), text) if dot else Name(text)
            names[raw] = found
        return found

    def noted(self, name: str) -> str:
        """Return a name, and remember whether the file has any that are private to a class."""
        self.has_private = self.has_private or is_private(name)
        return name

    def names_again(self, name: str, meant: Expr) -> None:
        """Let a name mean something else from here on."""
        raw, names = name.encode(), self.frame.names
        for dotted in [each for each in names if each.startswith(raw + b".")]:
            del names[dotted]
        names[raw] = meant

    def names_of(self, receiver: bytes) -> dict[bytes, Expr]:
        """Names seen in methods whose first parameter is `receiver`."""
        return self._receivers.setdefault(receiver, {receiver: THIS})

    def block(self, node: Node, deeper: int = 0) -> None:
        """Read the statements of a block that `deeper` more conditions enclose."""
        if self._nesting >= MAX_BLOCK_DEPTH:
            self.cut(node)
            return
        self._nesting += 1
        self.frame.depth += deeper
        handlers = self.statements
        for child in node.named_children:
            handler = handlers.get(child.type)
            if handler is not None:
                handler(self, child)
        self.frame.depth -= deeper
        self._nesting -= 1

    def inner(self, node: Node | None, deeper: int = 0) -> Block:
        """Read the statements of a block as a step of its own and return their flow."""
        self.frame.flow.begin()
        if node is not None:
            self.block(node, deeper)
        return self.frame.flow.end()

    def do(self, node: Node) -> None:
        """Emit an expression as a statement if it calls anything; one that yields is read in any case."""
        if node.type == "yield":
            self._yielded(node)
        elif self.data.find(b"(", node.start_byte, node.end_byte) >= 0:
            self.done(node)

    def _yielded(self, node: Node) -> None:
        """Emit what a function gives to one who asks, of which it does not use the answer."""
        self.frame.unanswered += 1
        value = self.expr(node)
        given = value.operands[0] if isinstance(value, Op) and value.op == "yield" else value
        kept = any(self.raw(child) == b"from" for child in node.children)
        self.emit("do", node, given, type_="yield from" if kept else "yield")

    def done(self, node: Node) -> Expr:
        """Read an expression once, and emit it as a statement if it calls anything."""
        before = self.calls
        value = self.expr(node)
        if self.calls > before:
            self.emit("do", node, value)
        return value

    def emit(
        self, kind: StatementKind, node: Node, value: Expr | None, target: Expr | None = None, type_: str = ""
    ) -> None:
        """Add a statement to the current body."""
        frame = self.frame
        deferred = frame.lambdas > 0
        frame.flow.add(len(frame.body))
        frame.body.append(Statement(kind, node.start_point[0] + 1, value, target, type_, frame.depth, deferred))

    def raw(self, node: Node) -> bytes:
        """Source bytes of a node."""
        return self.data[node.start_byte : node.end_byte]

    def text(self, node: Node | None) -> str:
        """Source text of a node on one line; empty when there is no node."""
        if node is None:
            return ""
        text = self.raw(node).decode("utf-8", "replace")
        return " ".join(text.split()) if "\n" in text else text

    def opaque(self, node: Node) -> Opaque:
        """Source text of a node that means nothing to the linker."""
        # Four bytes a character at most.
        end = min(node.end_byte, node.start_byte + 4 * OPAQUE_LENGTH)
        return Opaque(self.data[node.start_byte : end].decode("utf-8", "replace")[:OPAQUE_LENGTH])

    def cut(self, node: Node) -> Opaque:
        """Leave out a node that is nested too deeply, remembering the first such line."""
        self.cut_line = self.cut_line or node.start_point[0] + 1
        return self.opaque(node)


ExprHandler: TypeAlias = Callable[[Scan, Node], Expr]
StatementHandler: TypeAlias = Callable[[Scan, Node], None]


def parts(node: Node) -> list[Node]:
    """Named children that are neither comments nor what could not be parsed."""
    return [child for child in node.named_children if child.type not in SKIPPED]
