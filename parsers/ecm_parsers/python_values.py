"""Folded values of Python expressions, and the operators over them that make text and numbers."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import TypeAlias

import msgspec

MAX_TEXT = 4_000
_FIELD = re.compile(r"%[-#0 +]*\d*(?:\.\d+)?[sdifgrx]")
_BRACES = re.compile(r"\{(\w*)(?:[:!][^{}]*)?\}")


class Unknown(msgspec.Struct, frozen=True):
    """An expression whose value is not known, as written, cut at 80 characters."""

    text: str


class Table(msgspec.Struct, frozen=True):
    """A dict, in order."""

    entries: tuple[tuple[Value, Value], ...]


class PyCall(msgspec.Struct, frozen=True):
    """A call; `name` is dotted as written, `**spread` keywords have the name `**`."""

    name: str
    args: tuple[Value, ...]
    keywords: tuple[tuple[str, Value], ...]

    def keyword(self, name: str) -> Value | None:
        """Return the value of a keyword argument, or None."""
        return next((value for key, value in self.keywords if key == name), None)


class Value(msgspec.Struct, frozen=True):
    """A folded value with its 1-based line; lists, tuples and sets are tuples of values."""

    data: Data
    line: int


Data: TypeAlias = str | int | float | tuple[Value, ...] | Table | PyCall | Unknown | None
Names: TypeAlias = Mapping[str, Value]


def shown(value: Value) -> str:
    """Return text for a part of a text: the value, or `{expression}` when it is not known."""
    data = value.data
    if isinstance(data, str | int | float):
        return str(data)[:MAX_TEXT]
    return f"{{{data.text}}}" if isinstance(data, Unknown) else "{}"


def truth(value: Value) -> bool | None:
    """Return whether a value holds; None when that is not known."""
    data = value.data
    if isinstance(data, Unknown | PyCall) or (isinstance(data, str) and "{" in data):
        return None
    if isinstance(data, tuple) and data and all(map(_is_any_number, data)):
        return None
    return bool(data.entries) if isinstance(data, Table) else bool(data)


def is_counted(items: tuple[Value, ...]) -> bool:
    """Tell whether a list has as many elements as are written."""
    return not any(map(_is_any_number, items))


def _is_any_number(item: Value) -> bool:
    """Whether an element stands for any number of them: `*rows`, or a pattern of files."""
    text = item.data.text[:1] if isinstance(item.data, Unknown) else item.data
    return isinstance(text, str) and "*" in text


def either(before: Value | None, value: Value, name: str) -> Value:
    """Return what a variable holds behind a branch that is not decided: of two values none, of a list what it had."""
    if before is None or before.data == value.data:
        return value
    had, has = before.data, value.data
    if isinstance(had, tuple) and isinstance(has, tuple) and has[: len(had)] == had:
        return Value((*had, Value(Unknown(f"*{name}"[:80]), value.line)), value.line)
    return Value(Unknown(name[:80]), value.line)


def operate(operator: str, left: Value, right: Value) -> Data:
    """Apply an operator; None when the result is not known."""
    a, b = left.data, right.data
    if isinstance(a, int | float) and isinstance(b, int | float):
        return _arithmetic(operator, a, b)
    if operator == "+" and (isinstance(a, tuple) or isinstance(b, tuple)):
        return with_more(with_more((), left), right)
    if operator == "+" and (isinstance(a, str) or isinstance(b, str)):
        return (shown(left) + shown(right))[:MAX_TEXT]
    if operator == "%" and isinstance(a, str):
        values = iter(b if isinstance(b, tuple) else (right,))
        return _FIELD.sub(lambda match: _next_shown(values, match[0]), a)[:MAX_TEXT]
    return None


def with_more(items: tuple[Value, ...], more: Value) -> tuple[Value, ...]:
    """Return a list with the elements of another one, or with any number of them where that is not known."""
    added = (
        more.data if isinstance(more.data, tuple) else (Value(Unknown(f"*{shown(more).strip('{}')}"[:80]), more.line),)
    )
    return (*items, *added)[:MAX_TEXT]


def _next_shown(values: Iterator[Value], otherwise: str) -> str:
    value = next(values, None)
    return otherwise if value is None else shown(value)


def _arithmetic(operator: str, a: float, b: float) -> int | float | None:
    """Return the result of simple arithmetic on numbers of a sane size."""
    if max(abs(a), abs(b)) > 1e15 or (operator == "/" and b == 0):
        return None
    results: dict[str, Callable[[], int | float]] = {
        "+": lambda: a + b,
        "-": lambda: a - b,
        "*": lambda: a * b,
        "/": lambda: a / b,
    }
    return results[operator]() if operator in results else None


def format_text(text: str, call: PyCall) -> str:
    """Return what `text.format(...)` makes; a field that nothing fills stays."""
    return _BRACES.sub(_filler(call), text)[:MAX_TEXT]


def _filler(call: PyCall) -> Callable[[re.Match[str]], str]:
    """Return what fills the fields of `str.format`."""
    positional = iter(call.args)

    def fill(match: re.Match[str]) -> str:
        key = match[1]
        if not key:
            return _next_shown(positional, match[0])
        if key.isdecimal():
            return shown(call.args[int(key)]) if len(key) < 4 and int(key) < len(call.args) else match[0]
        value = call.keyword(key)
        return match[0] if value is None else shown(value)

    return fill
