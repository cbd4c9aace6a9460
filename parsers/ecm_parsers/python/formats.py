"""Texts that a format makes of values, each written as Python writes it where it is known."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from typing import Final

from ecm_parsers import expression_limits
from ecm_parsers.expression_limits import PERCENT, ExpressionError
from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.values import Unknown, Value, is_plain, merged_text, template_of
from ecm_parsers.template import Template

_MAX_INDEX: Final = 6
"""Digits of an index that are read: no call has as many arguments."""
_FIELD: Final = re.compile(r"\{\{|\}\}|\{(\w*)((?:![a-z])?(?::[^{}]*)?)\}")
_ESCAPED: Final = frozenset({"{{", "}}", "%%"})


def formatted(text: str, given: Arguments) -> Value:
    """Return `text.format(...)` as text with substitutions; a field that nothing fills stays."""
    following = iter(given.positional)
    return _filled(text, _FIELD, lambda field: _braces(field, given, following))


def percent_formatted(text: str, value: Value) -> Value:
    """Return `text % value` as text with substitutions; a field that nothing fills stays."""
    following = iter(value if isinstance(value, tuple) else (value,))
    return _filled(text, PERCENT, lambda field: _percent(field[0], value, following))


def as_formatted(value: Value, how: str) -> Template:
    """Return a value as `{value!r:>4}` of a formatted text writes it, whose end is `how`."""
    return _written(value, lambda: expression_limits.formatted(f"{{0{how}}}", [value], {}))


def _filled(text: str, fields: re.Pattern[str], fill: Callable[[re.Match[str]], Template]) -> Value:
    parts: Template = ()
    position = 0
    for field in fields.finditer(text):
        own = (field[0][0],) if field[0] in _ESCAPED else fill(field)
        parts = (*parts, text[position : field.start()], *own)
        position = field.end()
    return merged_text((*parts, text[position:]), is_str=True)


def _braces(field: re.Match[str], given: Arguments, following: Iterator[Value]) -> Template:
    key, how = field[1], field[2]
    try:
        if not key:
            return as_formatted(next(following), how)
        if key.isdecimal():
            return as_formatted(given.positional[int(key[:_MAX_INDEX])], how)
        return as_formatted(given.keywords[key], how)
    except (StopIteration, IndexError, KeyError):
        return (field[0],)


def _percent(field: str, value: Value, following: Iterator[Value]) -> Template:
    name, named, how = field[2:].rpartition(")") if field.startswith("%(") else ("", "", field[1:])
    try:
        each = value[name] if named else next(following)
    except (StopIteration, TypeError, KeyError):
        return (field,)
    return _written(each, lambda: expression_limits.percent_formatted(f"%{how}", (each,)))


def _written(value: Value, write: Callable[[], str]) -> Template:
    if isinstance(value, list | tuple | dict) and not is_plain(value):
        return template_of(Unknown(""))
    if not is_plain(value):
        return template_of(value)
    try:
        return (write(),)
    except (ExpressionError, TypeError, ValueError, OverflowError, LookupError, AttributeError):
        return template_of(Unknown(""))
