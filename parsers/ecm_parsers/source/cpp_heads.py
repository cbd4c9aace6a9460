"""What stands in the heads of statements of C++: variables, which end with the statement, and what directives ask.

Source: [basic.scope.block] of the C++ standard.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_parameters import declared_name
from ecm_parsers.source.expr import Expr, Op, Opaque

if TYPE_CHECKING:
    from tree_sitter import Node

_BEFORE = {"for_statement": "initializer", "if_statement": "condition", "while_statement": "condition"}
_BEFORE |= {"switch_statement": "condition", "for_range_loop": "declarator"}


_WORD = re.compile(rb"[A-Za-z_]\w*")


class LastNamed:
    """Where each word of what is read stands for the last time, which is looked up once.

    Args:
        data: of the file.
    """

    def __init__(self, data: bytes) -> None:
        self._data = data
        self._node: Node | None = None
        self._places: Mapping[bytes, int] | None = None

    def begin(self, node: Node) -> None:
        """Take a function, or another whole, as what is read."""
        self._node, self._places = node, None

    def is_behind(self, name: str, statement: Node) -> bool:
        """Tell whether something behind a statement is called so: another variable, a member, a constant."""
        if self._places is None:
            whole = self._node or statement
            words = _WORD.finditer(self._data, whole.start_byte, whole.end_byte)
            self._places = {word[0]: word.start() for word in words}
        return self._places.get(name.encode(), -1) >= statement.end_byte


def hides(reader: ExprReader, statement: Node, before: Set[str], last: LastNamed) -> bool:
    """Tell whether a statement gives a variable the name of one that was declared before it, or is named behind it."""
    field = _BEFORE.get(statement.type)
    header = statement.child_by_field_name(field) if field is not None else None
    if header is None:
        return False
    names = {declared_name(reader, header)} if statement.type == "for_range_loop" else set(_declared(reader, header))
    return not names.isdisjoint(before) or any(last.is_behind(name, statement) for name in names if name)


def macro_test(reader: ExprReader, node: Node, named: Node | None) -> Expr:
    """Return what a directive asks: `#if ` and the macro, or the condition as written."""
    test = Opaque(f"#if {reader.text(named)[:80] if named is not None else 'else'}")
    first = node.children[0].type if node.children else ""
    return Op("!", (test,)) if first.endswith("ifndef") else test


def _declared(reader: ExprReader, header: Node) -> Iterator[str]:
    if header.type == "declaration":
        yield from (declared_name(reader, each) for each in header.children_by_field_name("declarator"))
    elif header.type in {"condition_clause", "init_statement"}:
        for child in header.named_children:
            yield from _declared(reader, child)
