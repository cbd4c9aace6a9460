"""Expressions of Python that need not be evaluated: `a and b`, `b if a else c`. Source: Python reference, 6.11."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from tree_sitter import Node

from ecm_parsers.source.python_scan import EXTRAS

_ASKED_FIRST: Final[Mapping[str, int]] = MappingProxyType({"boolean_operator": 0, "conditional_expression": 1})
"""Choice -> which of its operands is evaluated in any case."""


def may_not_happen(node: Node) -> bool:
    """Tell whether an expression stands on a side of a choice that need not be evaluated."""
    around = node.parent
    while around is not None and not around.type.endswith("_statement"):
        first = _ASKED_FIRST.get(around.type)
        operands = [child for child in around.named_children if child.type not in EXTRAS] if first is not None else []
        if first is not None and node in operands and operands.index(node) != first:
            return True
        node, around = around, around.parent
    return False
