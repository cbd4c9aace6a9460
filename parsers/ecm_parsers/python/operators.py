"""Operators of Python, over plain data and over texts with substitutions."""

from __future__ import annotations

import ast

from ecm_parsers.expression_limits import ExpressionError, check_scalar
from ecm_parsers.expression_operators import COMPARE, UNARY
from ecm_parsers.expression_operators import binary as plain_binary
from ecm_parsers.python.formats import percent_formatted
from ecm_parsers.python.library import joined_path
from ecm_parsers.python.values import (
    MAX_ITEMS,
    Condition,
    Many,
    Modelled,
    Reference,
    Text,
    Unknown,
    Value,
    hashable,
    is_counted,
    merged_text,
    shown,
    template_of,
)
from ecm_parsers.template import Substitution, Template, negated

_NEVER_EMPTY = frozenset({"find", "find_prefix", "dirname", "file", "yaml", "command", "anon"})
_TEXTS = (str, Text, Unknown, Reference)
_NEGATIVE = (ast.NotEq, ast.NotIn, ast.IsNot)


def binary(kind: ast.operator, left: Value, right: Value) -> Value:
    """Return what an operator with two sides gives; Unknown when that is not known."""
    if isinstance(left, int | float) and isinstance(right, int | float):
        return _arithmetic(kind, left, right)
    if isinstance(kind, ast.Add):
        return _added(left, right)
    if isinstance(kind, ast.Mod) and isinstance(left, str):
        return percent_formatted(left, right)
    if isinstance(kind, ast.Div) and isinstance(left, Text | str):
        return joined_path((left, right))
    if isinstance(kind, ast.Mult) and isinstance(left, list | str) and isinstance(right, int):
        return left * right if 0 <= right * len(left) <= MAX_ITEMS else Unknown("*")
    return Unknown("operator")


def signed(kind: ast.unaryop, value: float) -> Value:
    """Return what a sign makes of a number."""
    try:
        return UNARY[type(kind)](value)
    except TypeError:
        return Unknown("sign")


def _arithmetic(kind: ast.operator, left: float, right: float) -> Value:
    try:
        found = plain_binary(type(kind), left, right)
        check_scalar(found)
    except (ExpressionError, ArithmeticError, TypeError, ValueError):
        return Unknown("arithmetic")
    return found


def _added(left: Value, right: Value) -> Value:
    left = left.items if isinstance(left, Modelled) else left
    right = right.items if isinstance(right, Modelled) else right
    if isinstance(left, list | tuple) and isinstance(right, list | tuple):
        joined = [*left, *right]
        return joined if isinstance(left, list) else tuple(joined)
    if isinstance(left, list | tuple) and isinstance(right, Unknown | Reference | Text):
        return [*left, Many(right)]
    if isinstance(right, list | tuple) and isinstance(left, Unknown | Reference | Text):
        return [Many(left), *right]
    if isinstance(left, _TEXTS) and isinstance(right, _TEXTS):
        return merged_text((*template_of(left), *template_of(right)), is_str=True)
    return Unknown("+")


def compare(kind: ast.cmpop, left: Value, right: Value) -> Value:
    """Return a truth value, or a condition over substitutions."""
    if _is_known(left) and _is_known(right):
        try:
            return bool(COMPARE[type(kind)](left, right))
        except TypeError:
            return Unknown("comparison")
    if isinstance(left, Unknown) or isinstance(right, Unknown) or not isinstance(kind, _TEXTUAL):
        return Unknown("comparison")
    if isinstance(kind, ast.Is | ast.IsNot) and (isinstance(left, Reference) or isinstance(right, Reference)):
        return Unknown("comparison")
    if isinstance(kind, ast.Is | ast.IsNot):
        return isinstance(kind, ast.IsNot)
    if isinstance(kind, ast.In | ast.NotIn):
        found = _contained(left, right)
    else:
        found = (Substitution("equals", (template_of(left), template_of(right))),)
    return Text(negated(found)) if isinstance(kind, _NEGATIVE) else Text(found)


_TEXTUAL = (ast.Eq, ast.NotEq, ast.In, ast.NotIn, ast.Is, ast.IsNot)


def _contained(item: Value, items: Value) -> Template:
    if isinstance(items, list | tuple):
        equal: tuple[Template, ...] = tuple(
            (Substitution("equals", (template_of(item), template_of(entry))),) for entry in items
        )
        return (Substitution("or", equal),)
    return (Substitution("in", (template_of(item), template_of(items))),)


def _is_known(value: Value) -> bool:
    if isinstance(value, list | tuple):
        return all(_is_known(item) for item in value)
    if isinstance(value, dict):
        return is_counted(value)
    return value is None or isinstance(value, str | int | float | bool)


def truth(value: Value) -> bool | Template:
    """Return whether a value holds, or the condition under which it does."""
    if isinstance(value, Text):
        return True if _is_never_empty(value.parts) else value.parts
    if isinstance(value, Condition):
        return value.holds
    if isinstance(value, Unknown | Reference) or _is_perhaps_empty(value):
        return (Substitution("unknown", ((shown(value),),)),)
    return bool(value)


def _is_perhaps_empty(value: Value) -> bool:
    return isinstance(value, list | tuple | dict) and bool(value) and all(isinstance(each, Many) for each in value)


def _is_never_empty(parts: Template) -> bool:
    """A path or a text with a written part holds, whatever the launch decides."""
    return any(isinstance(part, str) or part.kind in _NEVER_EMPTY for part in parts)


def subscript(owner: Value, key: Value) -> Value:
    """Return an item of a list or map, Unknown when there is none."""
    if isinstance(owner, dict):
        return owner.get(key, owner.get(Many(key), Unknown("item"))) if hashable(key) else Unknown("item")
    if not isinstance(owner, str) and not (isinstance(owner, list | tuple) and is_counted(owner)):
        return Unknown("item")
    if isinstance(key, int) and -len(owner) <= key < len(owner):
        return owner[key]
    if isinstance(key, slice):
        return owner[key]
    return Unknown("item")
