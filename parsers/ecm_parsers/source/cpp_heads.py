"""What stands in the heads of statements of C++: variables, which end with the statement, and what directives ask.

Source: [basic.scope.block] of the C++ standard.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.cpp_expr import ExprReader
from ecm_parsers.source.cpp_parameters import declared_name
from ecm_parsers.source.expr import Expr, Op, Opaque

if TYPE_CHECKING:
    from tree_sitter import Node

_BEFORE = {"for_statement": "initializer", "if_statement": "condition", "while_statement": "condition"}
_BEFORE |= {"switch_statement": "condition", "for_range_loop": "declarator"}


def hides(reader: ExprReader, statement: Node, before: Set[str]) -> bool:
    """Tell whether a statement gives a variable the name of one that was declared before it, or is named behind it."""
    field = _BEFORE.get(statement.type)
    header = statement.child_by_field_name(field) if field is not None else None
    if header is None:
        return False
    names = {declared_name(reader, header)} if statement.type == "for_range_loop" else set(_declared(reader, header))
    return not names.isdisjoint(before) or any(_is_named_behind(reader, statement, name) for name in names if name)


def _is_named_behind(reader: ExprReader, statement: Node, name: str) -> bool:
    """Whether the block around a statement names behind it what is another variable there: a member, a constant."""
    around = statement.parent
    rest = reader.data[statement.end_byte : around.end_byte] if around is not None else b""
    return re.search(rb"\b" + re.escape(name.encode()) + rb"\b", rest) is not None


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
