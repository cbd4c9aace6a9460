"""Operators of expressions, none of which makes more than is allowed."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any

from ecm_parsers.expression_limits import ExpressionError, check_repetition, percent_formatted, power, shifted

_BINARY: Mapping[type[ast.operator], Callable[[Any, Any], Any]] = MappingProxyType(
    {
        ast.Add: operator.add,
        ast.Sub: operator.sub,
        ast.Mult: operator.mul,
        ast.Div: operator.truediv,
        ast.FloorDiv: operator.floordiv,
        ast.Mod: operator.mod,
        ast.Pow: power,
        ast.LShift: shifted,
        ast.RShift: operator.rshift,
        ast.BitAnd: operator.and_,
        ast.BitOr: operator.or_,
        ast.BitXor: operator.xor,
    }
)
UNARY: Mapping[type[ast.unaryop], Callable[[Any], Any]] = MappingProxyType(
    {ast.USub: operator.neg, ast.UAdd: operator.pos, ast.Not: operator.not_, ast.Invert: operator.invert}
)
COMPARE: Mapping[type[ast.cmpop], Callable[[Any, Any], bool]] = MappingProxyType(
    {
        ast.Eq: operator.eq,
        ast.NotEq: operator.ne,
        ast.Lt: operator.lt,
        ast.LtE: operator.le,
        ast.Gt: operator.gt,
        ast.GtE: operator.ge,
        ast.In: lambda item, items: item in items,
        ast.NotIn: lambda item, items: item not in items,
        ast.Is: operator.is_,
        ast.IsNot: operator.is_not,
    }
)


def binary(kind: type[ast.operator], left: Any, right: Any) -> Any:
    """Return what an operator with two sides gives.

    Raises:
        ExpressionError: it is not allowed, or would give too much.
    """
    function = _BINARY.get(kind)
    if function is None:
        msg = f"{kind.__name__} is not allowed in an expression. Write it without."
        raise ExpressionError(msg)
    if kind is ast.Mult:
        check_repetition(left, right)
    if kind is ast.Mod and isinstance(left, str):
        return percent_formatted(left, right)
    return function(left, right)
