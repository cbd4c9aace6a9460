"""Operators, formats and methods of texts and numbers, as Python and C++ compute them, on data that is known."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, Final

from ecm_parsers.numbers import INT_MAX, INT_MIN

MAX_TEXT: Final = 16_384
"""Characters of a text that is put together."""
MAX_POWER: Final = 64
_WIDTH: Final = 3
_CONVERSION: Final = re.compile(r"%[-+ #0]*(\d*)(?:\.(\d+))?(?:hh|h|ll|l|z|j|t|L)?([a-zA-Z])")


class _Unknown:
    """What is not computed; not equal to any data."""

    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN: Final = _Unknown()


class _Null:
    """`None`, `nullptr`."""

    def __repr__(self) -> str:
        return "NULL"


NULL: Final = _Null()


def is_number(value: Any) -> bool:
    """Tell whether data is a number and no truth value."""
    return isinstance(value, int | float) and not isinstance(value, bool)


def truth(value: Any, python: bool) -> bool | None:
    """Return whether data counts as true."""
    if isinstance(value, bool) or is_number(value):
        return bool(value)
    if value is NULL:
        return False
    return bool(value) if isinstance(value, str) and python else None


def operate(op: str, left: Any, right: Any, python: bool) -> Any:
    """Return what an operator gives for two operands."""
    if op in _COMPARED:
        return _compare(op, left, right)
    if op in {"in", "not in"}:
        found = left in right if isinstance(left, str) and isinstance(right, str) else UNKNOWN
        return found if found is UNKNOWN or op == "in" else not found
    if isinstance(left, str) and isinstance(right, str):
        return left + right if op == "+" and len(left) + len(right) <= MAX_TEXT else UNKNOWN
    if python and op == "*" and isinstance(left, str) and isinstance(right, int):
        return left * right if len(left) * max(0, right) <= MAX_TEXT else UNKNOWN
    if not _counts(left) or not _counts(right):
        return UNKNOWN
    return _in_range(_arithmetic(op, left, right, python))


def _counts(value: Any) -> bool:
    return isinstance(value, int | float)


def _compare(op: str, left: Any, right: Any) -> Any:
    alike = (_counts(left) and _counts(right)) or type(left) is type(right)
    if op in {"==", "!="}:
        same = left == right if alike else UNKNOWN if NULL not in (left, right) else False
        return same if same is UNKNOWN or op == "==" else not same
    if not alike or not isinstance(left, int | float | str):
        return UNKNOWN
    return _COMPARED[op](left, right)


_COMPARED: Final[Mapping[str, Callable[[Any, Any], bool]]] = MappingProxyType(
    {
        "==": lambda left, right: left == right,
        "!=": lambda left, right: left != right,
        "<": lambda left, right: left < right,
        ">": lambda left, right: left > right,
        "<=": lambda left, right: left <= right,
        ">=": lambda left, right: left >= right,
    }
)


def _arithmetic(op: str, left: Any, right: Any, python: bool) -> Any:
    whole = isinstance(left, int) and isinstance(right, int)
    if op in {"/", "//", "%"} and right == 0:
        return UNKNOWN
    if op == "/" and not python:
        return _truncated(left, right) if whole else left / right
    if op == "%" and not python:
        return left - _truncated(left, right) * right if whole else UNKNOWN
    if op == "**":
        small = abs(left) <= MAX_POWER and abs(right) <= MAX_POWER and left > 0
        return left**right if small else UNKNOWN
    work = _ARITHMETIC.get(op)
    return work(left, right) if work is not None else UNKNOWN


def _truncated(left: int, right: int) -> int:
    return abs(left) // abs(right) * (1 if (left < 0) == (right < 0) else -1)


_ARITHMETIC: Final[Mapping[str, Callable[[Any, Any], Any]]] = MappingProxyType(
    {
        "+": lambda left, right: left + right,
        "-": lambda left, right: left - right,
        "*": lambda left, right: left * right,
        "/": lambda left, right: left / right,
        "//": lambda left, right: left // right,
        "%": lambda left, right: left % right,
    }
)


def _in_range(value: Any) -> Any:
    """A number that a parameter can hold: an integer of 64 bit, or finite."""
    if isinstance(value, int):
        return value if INT_MIN <= value <= INT_MAX else UNKNOWN
    return value if isinstance(value, float) and math.isfinite(value) else UNKNOWN


def shown(value: Any, python: bool) -> Any:
    """Return the text of data: `str(x)`, `std::to_string(x)`."""
    if isinstance(value, str):
        return value
    if python:
        return "None" if value is NULL else str(value) if isinstance(value, bool | int | float) else UNKNOWN
    if isinstance(value, bool | int):
        return str(int(value))
    return f"{value:f}" if isinstance(value, float) else UNKNOWN


def streamed(value: Any) -> Any:
    """Return what `stream << x` writes."""
    if isinstance(value, float):
        text = f"{value:.6g}"
        return text if "e" not in text else UNKNOWN
    return shown(value, False)


def formatted(value: Any, spec: str, python: bool) -> Any:
    """Return data in a format: `%02d`, or what stands behind the colon of a brace format, `!r` in front of it."""
    if spec.startswith("%"):
        return _printed(value, spec)
    if not spec:
        return shown(value, True) if python or not isinstance(value, float) else UNKNOWN
    digits = re.findall(r"\d+", spec)
    if spec.startswith("!") or value is NULL or not python or any(len(entry) > _WIDTH for entry in digits):
        return UNKNOWN if spec != "!s" else shown(value, True)
    try:
        return format(value, spec)
    except (ValueError, TypeError):
        return UNKNOWN


def _printed(value: Any, spec: str) -> Any:
    match = _CONVERSION.fullmatch(spec)
    if match is None or any(len(group or "") > _WIDTH for group in match.groups()[:2]):
        return UNKNOWN
    kind = match[3]
    plain = re.sub(r"(?:hh|h|ll|l|z|j|t|L)(?=[a-zA-Z]$)", "", spec)
    if kind == "s":
        return plain % shown(value, True) if shown(value, True) is not UNKNOWN else UNKNOWN
    fits = isinstance(value, int) if kind in "diuxXoc" else _counts(value) if kind in "feEgG" else False
    return plain % value if fits and kind != "c" else UNKNOWN


def method(name: str, subject: str, args: Sequence[Any], python: bool) -> Any:
    """Return what a method of a text gives; UNKNOWN for a method or arguments that are not known."""
    work = (_PYTHON if python else _CPP).get(name)
    if work is None:
        return UNKNOWN
    try:
        found = work(subject, *args)
    except (TypeError, ValueError, IndexError, AttributeError):
        return UNKNOWN
    return UNKNOWN if isinstance(found, str) and len(found) > MAX_TEXT else found


def changed(name: str, subject: str, args: Sequence[Any]) -> Any:
    """Return what a text of C++ is after a method changed it."""
    work = _CHANGED.get(name)
    if work is None:
        return UNKNOWN
    try:
        found = work(subject, *args)
    except (TypeError, ValueError, IndexError):
        return UNKNOWN
    return found if isinstance(found, str) and len(found) <= MAX_TEXT else UNKNOWN


def _from(text: str, position: int = 0, count: int | None = None) -> str:
    if not 0 <= position <= len(text) or (count is not None and count < 0 and count != -1):
        raise IndexError
    return text[position:] if count is None or count == -1 else text[position : position + count]


NOWHERE: Final = 2**64 - 1
"""`std::string::npos`."""


def _found(position: int) -> int:
    return position if position >= 0 else NOWHERE


_PYTHON: Final[Mapping[str, Callable[..., Any]]] = MappingProxyType(
    {
        name: getattr(str, name)
        for name in [
            "lower",
            "upper",
            "strip",
            "lstrip",
            "rstrip",
            "replace",
            "split",
            "startswith",
            "endswith",
            "title",
            "capitalize",
            "removeprefix",
            "removesuffix",
            "zfill",
            "partition",
            "rpartition",
            "rsplit",
            "find",
            "rfind",
            "count",
            "index",
            "swapcase",
            "isdigit",
            "isalpha",
            "isidentifier",
            "casefold",
        ]
    }
)
_CPP: Final[Mapping[str, Callable[..., Any]]] = MappingProxyType(
    {
        "substr": _from,
        "size": lambda text: len(text.encode()),
        "length": lambda text: len(text.encode()),
        "empty": lambda text: not text,
        "find": lambda text, what, start=0: _found(text.find(what, start)),
        "rfind": lambda text, what: _found(text.rfind(what)),
        "find_last_of": lambda text, what: _found(max(text.rfind(char) for char in what)),
        "find_first_of": lambda text, what: _found(min((text.find(char) for char in what if char in text), default=-1)),
        "back": lambda text: text[-1],
        "front": lambda text: text[0],
        "at": lambda text, index: text[index] if index >= 0 else UNKNOWN,
        "compare": lambda text, other: (text > other) - (text < other),
        "starts_with": lambda text, other: text.startswith(other),
        "ends_with": lambda text, other: text.endswith(other),
    }
)


def _insert(text: str, position: int, more: str) -> str:
    if not 0 <= position <= len(text):
        raise IndexError
    return text[:position] + more + text[position:]


def _replace(text: str, position: int, count: int, more: str) -> str:
    if not 0 <= position <= len(text) or count < 0:
        raise IndexError
    return text[:position] + more + text[position + count :]


def _erase(text: str, position: int = 0, count: int | None = None) -> str:
    return text[:position] + text[position + len(_from(text, position, count)) :]


_CHANGED: Final[Mapping[str, Callable[..., Any]]] = MappingProxyType(
    {
        "append": lambda text, more: text + more,
        "push_back": lambda text, more: text + more,
        "insert": _insert,
        "replace": _replace,
        "erase": _erase,
        "clear": lambda text: "",
        "pop_back": lambda text: text[:-1] if text else UNKNOWN,
        "assign": lambda text, more: more + "",
        "resize": lambda text, size, fill: text[:size] + fill * (size - len(text)),
        "str": lambda text, more: more + "",
    }
)


def with_character(data: list[object]) -> object:
    """Return a text with another character at a place."""
    text, index, char = data
    if not isinstance(text, str) or not isinstance(index, int) or not isinstance(char, str):
        return UNKNOWN
    return text[:index] + char + text[index + 1 :] if len(char) == 1 and 0 <= index < len(text) else UNKNOWN
