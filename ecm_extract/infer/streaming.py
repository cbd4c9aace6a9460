"""What a stream of C++ writes, by the manipulators that it was given."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

from ecm_extract.infer.compute import UNKNOWN, is_number, streamed

MAX_WIDTH: Final = 999
_DIGITS: Final = {10: "d", 16: "x", 8: "o"}
_PREFIXES: Final = {10: "", 16: "0x", 8: "0"}


@dataclass(frozen=True, slots=True)
class StreamFormat:
    """How a stream writes what comes next; en.cppreference.com, std::basic_ios::init, says how it begins.

    Attributes:
        width: characters of the next output at least, which that uses up.
        fill: what is written in front of what is shorter. adjust: where that stands.
        base: of whole numbers. prefix: whether it is written. plus: whether numbers that are positive get a sign.
        precision: digits of other numbers. floats: how those are written, by the letter of `printf`.
        words: whether truth values are written as words. upper: whether letters in numbers are large.
    """

    width: int = 0
    fill: str = " "
    adjust: str = "right"
    base: int = 10
    prefix: bool = False
    plus: bool = False
    precision: int = 6
    floats: str = "g"
    words: bool = False
    upper: bool = False


PLAIN: Final = StreamFormat()


def written(value: Any, how: StreamFormat) -> Any:
    """Return what a stream writes of data; UNKNOWN for what is not computed."""
    text = _text(value, how)
    if not isinstance(text, str) or not 0 <= how.width <= MAX_WIDTH or len(how.fill) != 1:
        return UNKNOWN
    lacking = max(0, how.width - len(text.encode())) * how.fill
    if how.adjust == "internal" and lacking and is_number(value):
        return UNKNOWN  # between the sign or the base and the digits
    return text + lacking if how.adjust == "left" else lacking + text


def _text(value: Any, how: StreamFormat) -> Any:
    if isinstance(value, bool):
        return ("true" if value else "false") if how.words else str(int(value))
    if isinstance(value, int):
        return _whole(value, how)
    return _fraction(value, how) if isinstance(value, float) else streamed(value)


def _whole(value: int, how: StreamFormat) -> Any:
    """A whole number; one below zero depends on its type in other bases than ten."""
    if how.base not in _DIGITS or (value < 0 and how.base != 10):
        return UNKNOWN
    sign = "+" if how.plus and value >= 0 and how.base == 10 else ""
    prefix = _PREFIXES[how.base] if how.prefix and value else ""
    text = sign + prefix + format(value, _DIGITS[how.base])
    return text.upper() if how.upper else text


def _fraction(value: float, how: StreamFormat) -> Any:
    if not 0 <= how.precision <= MAX_WIDTH:
        return UNKNOWN
    text = format(value, f"{'+' if how.plus else ''}.{how.precision}{how.floats}")
    if how.floats == "g" and "e" in text:
        return UNKNOWN
    return text.upper() if how.upper else text
