"""What stands in a statement: its identifiers and its texts."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Final

from ecm_parsers.source.expr import Member, Name, Text
from ecm_parsers.source.facts import Statement

MAX_DEPTH: Final = 60


def identifiers(statement: Statement) -> Iterator[str]:
    """Names of variables, functions and members, without what qualifies them."""
    for node in _nodes(statement):
        if isinstance(node, Name):
            yield node.id.rsplit("::", 1)[-1]
        elif isinstance(node, Member):
            yield node.name


def texts(statement: Statement) -> Iterator[str]:
    """Values of literals of text."""
    for node in _nodes(statement):
        if isinstance(node, Text):
            yield node.value


def _nodes(statement: Statement) -> Iterator[object]:
    for part in (statement.target, statement.value):
        yield from _below(part, 0)


def _below(part: object, depth: int) -> Iterator[object]:
    if isinstance(part, tuple):
        for item in part:
            yield from _below(item, depth + 1)
    elif hasattr(part, "__struct_fields__") and depth < MAX_DEPTH:
        yield part
        for field in part.__struct_fields__:
            yield from _below(getattr(part, field), depth + 1)
