"""Bounds of an expression: what it may build, and how much work it may be."""

from __future__ import annotations

import math
import re
import string
from typing import Any

MAX_SIZE = 20_000
MAX_WORK = 400_000
MAX_INTEGER = 1 << 256
_FORMAT_SPEC = re.compile(r"(?:.?[<>=^])?[+\- ]?#?\d{0,3}[,_]?(?:\.\d{1,2})?[a-zA-Z%]?")
PERCENT = re.compile(r"%(?:%|(?:\([^()]*\))?[#0\- +]*\d{0,3}(?:\.\d{1,2})?[a-zA-Z])")
_PADDING = frozenset({"zfill", "ljust", "rjust", "center"})
_LARGEST_FACTORIAL = 57
"""The last one below `MAX_INTEGER`."""
TOO_LARGE = "The value grows too large. Shorten the expression."


class ExpressionError(Exception):
    """An expression that cannot be evaluated; the message says why."""


class UnknownNameError(ExpressionError):
    """An expression that uses a name without a value, so that its value is known only elsewhere."""


class Budget:
    """How much work several expressions may do together; a unit is about one character or item that is made."""

    def __init__(self, units: int = MAX_WORK) -> None:
        self.left = units

    def spend(self, units: int) -> None:
        """Take units away.

        Raises:
            ExpressionError: none are left.
        """
        self.left -= units
        if self.left < 0:
            raise ExpressionError(TOO_LARGE)


def size_of(value: Any) -> int:
    """Return how many characters and items a value holds on all levels; counting stops beyond the bound."""
    size, pending = 0, [value]
    while pending and size <= MAX_SIZE:
        item = pending.pop()
        size += len(item) if isinstance(item, str | list | tuple | dict) else 1
        if isinstance(item, list | tuple):
            pending.extend(item)
        elif isinstance(item, dict):
            pending.extend([*item.keys(), *item.values()])
    return size


def check_scalar(value: Any) -> None:
    """Refuse numbers and kinds of values that no expression of a robot needs."""
    if isinstance(value, int) and abs(value) > MAX_INTEGER:
        raise ExpressionError(TOO_LARGE)
    if isinstance(value, bytes | complex) or value is ...:
        msg = "Bytes and complex numbers are not allowed in an expression. Write a text or number."
        raise ExpressionError(msg)


def check_repetition(left: Any, right: Any) -> None:
    """Refuse `text * number` whose result is too large, before it is made."""
    for items, times in ((left, right), (right, left)):
        if isinstance(items, str | list | tuple) and isinstance(times, int) and len(items) * times > MAX_SIZE:
            raise ExpressionError(TOO_LARGE)


def check_growth(method: str, owner: Any, args: list[Any]) -> None:
    """Refuse `replace`, `join` and padding whose result is larger than what they are given, before it is made."""
    if method in _PADDING and args and isinstance(args[0], int) and args[0] > MAX_SIZE:
        raise ExpressionError(TOO_LARGE)
    if method == "replace" and len(args) > 1 and len(owner) * (len(str(args[1])) + 1) > MAX_SIZE:
        raise ExpressionError(TOO_LARGE)
    if method == "join" and args and isinstance(args[0], str | list | tuple) and len(owner) * len(args[0]) > MAX_SIZE:
        raise ExpressionError(TOO_LARGE)


def formatted(text: str, args: list[Any], keywords: dict[str, Any]) -> str:
    """Format with plain fields only: no attributes, no nested fields, no wide padding."""
    for _, field, spec, _ in string.Formatter().parse(text):
        if field and not field.isidentifier() and not field.isdecimal():
            msg = f"{field}:{spec}"
            raise _bad_format(msg)
        check_format(spec or "")
    return text.format(*args, **keywords)


def check_format(spec: str) -> None:
    """Refuse what a value is formatted by when it is no plain, narrow one."""
    if not _FORMAT_SPEC.fullmatch(spec):
        raise _bad_format(spec)


def percent_formatted(text: str, values: Any) -> str:
    """Format by `%` with plain fields only: no width from a value, no wide padding."""
    left = PERCENT.sub("", text)
    if "%" in left:
        raise _bad_format(left)
    done: str = text % values
    return done


def _bad_format(field: str) -> ExpressionError:
    return ExpressionError(f"Format field `{field}` is not allowed in an expression. Use +."[:200])


def power(base: Any, exponent: Any) -> Any:
    """Return a power of a bounded size.

    Raises:
        ExpressionError: it is too large or no real number.
    """
    if isinstance(base, int) and isinstance(exponent, int) and exponent >= 0:
        if abs(base) > 1 and exponent * math.log2(abs(base)) > 256:
            raise ExpressionError(TOO_LARGE)
        return base**exponent
    result = float(base) ** float(exponent)
    if isinstance(result, complex):
        msg = "A root of a negative number is no number. Correct the expression."
        raise ExpressionError(msg)
    return result


def factorial(number: int) -> int:
    """Return a factorial of a bounded size.

    Raises:
        ExpressionError: it is too large.
    """
    if number > _LARGEST_FACTORIAL:
        raise ExpressionError(TOO_LARGE)
    return math.factorial(number)


def shifted(number: int, places: int) -> int:
    """Return a number shifted to the left, of a bounded size.

    Raises:
        ExpressionError: it is too large.
    """
    if places > MAX_INTEGER.bit_length():
        raise ExpressionError(TOO_LARGE)
    return number << places


def bounded_range(*bounds: int) -> list[int]:
    """Return a range as a list.

    Raises:
        ExpressionError: it is too long.
    """
    found = range(*bounds)
    if len(found) > MAX_SIZE:
        raise ExpressionError(TOO_LARGE)
    return list(found)
