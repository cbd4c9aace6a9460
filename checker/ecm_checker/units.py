"""Units of contract fields: dimension and factor to the unit of REP 103."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping
from functools import cache
from importlib import resources
from typing import Any, Final, NamedTuple

_QUANTITY: Final = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-z%][\w%/*.^]*)?\s*")
_LONGEST: Final = 80
_MOST: Final = 10**300
"""Integers beyond it are no double, and no quantity of a robot."""


class Unit(NamedTuple):
    """A unit: physical dimension and how many SI units it is."""

    dimension: str
    factor: float


class Quantity(NamedTuple):
    """A number in SI units; the dimension is empty for a bare number."""

    value: float
    dimension: str


@cache
def table() -> Mapping[str, Unit]:
    """Units by lower-case spelling."""
    text = (resources.files("ecm_checker") / "data" / "units.toml").read_text("utf-8")
    rows: dict[str, list[Any]] = tomllib.loads(text)["units"]
    return {name: Unit(row[0], row[1]) for name, row in rows.items()}


def unit(text: str) -> Unit | None:
    """The unit of a spelling; None when it is not known."""
    return table().get(text.strip().lower())


def quantity(value: object) -> Quantity | None:
    """A number with or without a unit (`0.5 m`, `4GB`, `30`); None when it is no such thing."""
    if isinstance(value, bool):
        return None
    if isinstance(value, int | float):
        return Quantity(float(value), "") if abs(value) <= _MOST or isinstance(value, float) else None
    found = _QUANTITY.fullmatch(value) if isinstance(value, str) and len(value) <= _LONGEST else None
    if found is None:
        return None
    number, spelling = float(found[1]), found[2]
    if not spelling:
        return Quantity(number, "")
    known = unit(spelling)
    return Quantity(number * known.factor, known.dimension) if known is not None else None


def number(value: object) -> float | None:
    """The number of a quantity in SI units; None when it is none."""
    found = quantity(value)
    return found.value if found is not None else None
