"""Defaults of ROS parameters within values: what they are, and values by what a run has asked of them."""

from __future__ import annotations

from collections.abc import Mapping, Set
from typing import NamedTuple, TypeAlias

from ecm_parsers.source.expr import Constant, Expr, Number, Text

from ecm_extract.infer.compute import NULL
from ecm_extract.link.running.values import Enumerator, Hole, OfParameter, Value, setting_of

Part: TypeAlias = str | Hole | OfParameter
"""A part of a value: a text, what is open, or what a ROS parameter gives."""


class Asked(NamedTuple):
    """What a run that gets to a place found of a parameter: its text, or None where it has not its default."""

    part: OfParameter
    text: str | None = None


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


def by_asked(value: Value, asked: Set[Asked]) -> Value:
    """The same value by what a run has asked of its parameters: what they are, or that they are not their defaults."""
    texts = {each.part: each.text for each in asked}
    if texts.keys().isdisjoint(value.template):
        return value
    template = tuple([_answered(part, texts) for part in value.template])
    parts = [each for part in template for each in (part.default if isinstance(part, OfParameter) else (part,))]
    if any(isinstance(part, Hole | OfParameter) for part in template):
        return Value(tuple(parts), "pattern", template, beside=value.beside and "pattern")
    return Value(tuple(parts), "one_of" if value.confidence == "one_of" else "folded")


def _answered(part: Part, texts: Mapping[OfParameter, str | None]) -> Part:
    """A part of a value as its parameter was found to be; open where it is only known not to have its default."""
    if not isinstance(part, OfParameter) or part not in texts:
        return part
    text = texts[part]
    return part._replace(default=setting_of(part.parameter).parts) if text is None else text
