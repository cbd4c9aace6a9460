"""Calls that make a number of something: of another number, in Python of a text."""

from __future__ import annotations

from ecm_parsers.numbers import integer, real

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.link.code.numbers import NUMBERS, as_number, type_of_number
from ecm_extract.link.folding.declared_numbers import held_as
from ecm_extract.link.running.values import Value, constant, data_in, unknown


def converted(value: Value, kind: str, python: bool) -> Value:
    """Return a value as a number of a kind: `int(x)`, `static_cast<uint8_t>(x)`."""
    given = data_in(value) if value.data is None else value.data
    if isinstance(given, str):
        return _parsed(value, given, kind) if python else unknown(kind)
    data = as_number(value.data, kind) if python else held_as(value.data, type_of_number(kind))
    if data is UNKNOWN:
        return unknown(kind)
    return value if data is value.data else constant(data)._replace(confidence="folded")


def _parsed(value: Value, text: str, kind: str) -> Value:
    """The number that a text of Python spells: `int("5")`."""
    found = real(text) if NUMBERS[kind] == "double" else integer(text.strip())
    return (
        unknown(kind)
        if found is None
        else constant(found)._replace(confidence=value.confidence, template=value.template)
    )
