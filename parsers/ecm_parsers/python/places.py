"""Values that know the line on which the file writes them, for readers that tell it of each element of a list."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from ecm_parsers.python.values import Many, Text, Unknown, Value


class Written(str):
    """A text, and its line."""

    __slots__ = ("line",)
    line: int


class Row(tuple[Value, ...]):
    """A tuple, and its line."""

    line: int


class Listed(list[Value]):
    """A list, and its line."""

    line: int


def placed(value: Value, node: ast.expr) -> Value:
    """Return a value with the line on which an expression has it; a list keeps its own, since it may yet change."""
    if isinstance(value, Unknown):
        return Unknown("" if isinstance(node, ast.Call) else value.text, node.lineno)
    if isinstance(value, Text | Many):
        return replace(value, line=node.lineno)
    kind = _PLACED.get(type(value))
    if kind is None:
        return value
    made = kind(value)
    made.line = node.lineno
    return made


def line_of(value: Value, otherwise: int = 0) -> int:
    """Return the line of a value, another one where it has none."""
    line = getattr(value, "line", 0)
    return line if isinstance(line, int) and line else otherwise


_PLACED: Mapping[type, type[Written | Row | Listed]] = MappingProxyType(
    {str: Written, Written: Written, tuple: Row, Row: Row, list: Listed}
)
