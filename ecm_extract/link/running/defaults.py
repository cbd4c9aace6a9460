"""Defaults of ROS parameters within values: what they are, and values without some of them."""

from __future__ import annotations

from collections.abc import Set
from typing import NamedTuple

from ecm_parsers.source.expr import Constant, Expr, Number, Text

from ecm_extract.infer.compute import NULL
from ecm_extract.link.running.values import Enumerator, OfParameter, Value, setting_of


class Default(NamedTuple):
    """What a ROS parameter is as long as nobody sets it: a part of values, and as an expression."""

    part: OfParameter
    value: Expr


def default_of(value: Value) -> Default | None:
    """Return the default of the parameter whose value this is and nothing else; None where it has none."""
    part = value.template[0] if len(value.template) == 1 else None
    if not isinstance(part, OfParameter) or isinstance(value.data, Enumerator):
        return None
    if not all(isinstance(each, str) for each in part.default):
        return None
    return Default(part, stated(value._replace(parts=part.default)))


def stated(value: Value) -> Expr:
    """Return what gives a value that is known."""
    if isinstance(value.data, int | float) and not isinstance(value.data, bool):
        return Number(value.data)
    return (
        Text(value.text) if value.data is None else Constant("null" if value.data is NULL else str(value.data).lower())
    )


def without_those(value: Value, excluded: Set[OfParameter]) -> Value:
    """The same value where some parameters are surely set to something else than their defaults."""
    if excluded.isdisjoint(value.template):
        return value
    template = [
        part._replace(default=setting_of(part.parameter).parts)
        if isinstance(part, OfParameter) and part in excluded
        else part
        for part in value.template
    ]
    parts = [each for part in template for each in (part.default if isinstance(part, OfParameter) else (part,))]
    return Value(tuple(parts), "pattern", tuple(template), beside=value.beside and "pattern")
