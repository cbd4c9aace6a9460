"""Numbers as the declared type of a variable of C++ holds them.

Source: [conv.integral], [conv.fpint], [conv.bool] of the C++ standard; a signed number that does not
fit is wrapped, as every compiler for the platforms of REP 2000 does.
"""

from __future__ import annotations

import struct
from typing import Any, Final

from ecm_parsers.numbers import truncated
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.link.code.numbers import BITS, WITHOUT_SIGN, type_of_number
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.values import Value, constant, unknown

_DIGITS: Final = 9
"""Digits that tell each `float` from all others ([numeric.limits.members], `max_digits10`)."""
_LONG: Final = 12
"""Characters of a fraction that nobody writes as it is."""


def as_declared(values: tuple[Value, ...], statement: Statement | None, func: Func) -> tuple[Value, ...]:
    """Return values as the type of the variable that a statement gives them to holds them: `double x = 1` is 1.0."""
    name = type_of_number(_type_given(statement, func)) if statement is not None else ""
    return in_type(values, name) if name else values


def in_type(values: tuple[Value, ...], name: str) -> tuple[Value, ...]:
    """Return values as a type of numbers holds them, by its short form."""
    return tuple([_cast(value, name) for value in values])


def _type_given(statement: Statement, func: Func) -> str:
    """The declared type of the variable that a statement of C++ gives something, empty for none."""
    if func.file.language != "cpp":
        return ""
    name = getattr(statement.target, "id", "")
    return statement.type if statement.kind in {"let", "each"} else func.written_types.get(name, "")


def _cast(value: Value, name: str) -> Value:
    data = held_as(value.data, name)
    if data is UNKNOWN:
        return unknown("value")
    return (
        value if data is value.data else constant(data)._replace(confidence=value.confidence, template=value.template)
    )


def held_as(data: Any, name: str) -> Any:
    """Return a number as a type holds it; other data as they are, UNKNOWN for what becomes a character."""
    if not isinstance(data, int | float):
        return data
    if name == "bool":
        return bool(data)
    if name in {"float", "double"}:
        return _fraction(float(data), name)
    whole = truncated(data)
    if whole is None or name == "char":
        return UNKNOWN
    bits = BITS[name]
    wrapped = whole % 2**bits
    wrapped -= 2**bits if name not in WITHOUT_SIGN and wrapped >= 2 ** (bits - 1) else 0
    return data if type(data) is int and wrapped == data else wrapped


def as_spelled(data: Any) -> Any:
    """Return the shortest number that a `float` holds alike: 0.1 of what `0.1f` is, as people write and read it."""
    if isinstance(data, list):
        return [as_spelled(each) for each in data]
    long = isinstance(data, float) and not data.is_integer() and len(repr(data)) > _LONG
    if not long or _fraction(data, "float") != data:
        return data
    texts = (f"{data:.{digits}g}" for digits in range(1, _DIGITS + 1))
    return next((float(text) for text in texts if _fraction(float(text), "float") == data), data)


def _fraction(data: float, name: str) -> Any:
    if name == "double":
        return data
    try:
        return struct.unpack("f", struct.pack("f", data))[0]
    except OverflowError:
        return UNKNOWN
