"""Angles as rosparam reads them: `!degrees 90`, `!radians pi/2`, `deg(90)` and `rad(pi/2)`, all in radians.

Source: wiki.ros.org/rosparam, "Radians and degrees".
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Final

from ecm_parsers.expression import ExpressionError, evaluate
from ecm_parsers.yaml_scalar import PlainScalar, typed_by_pyyaml
from ecm_parsers.yaml_tree import Scalar

_Unit = Callable[[float], float]


def _of_degrees(angle: float) -> float:
    """In the order of rosparam, which decides the last digit."""
    return angle * math.pi / 180.0


_TAGS: Final[Mapping[str, _Unit]] = MappingProxyType({"!degrees": _of_degrees, "!radians": float})
_CALLS: Final[Mapping[str, _Unit]] = MappingProxyType({"deg(": _of_degrees, "rad(": float})


def typed_by_rosparam(text: str) -> PlainScalar:
    """Return what a text without quotes means: `deg(...)` and `rad(...)` are numbers, others as in PyYAML."""
    unit = _CALLS.get(text[:4]) if text.endswith(")") else None
    radians = _number(text[4:-1], unit) if unit is not None else None
    return typed_by_pyyaml(text) if radians is None else radians


def of_rosparam(scalar: Scalar) -> PlainScalar:
    """Return the value of a scalar, in radians where its tag says that it is an angle."""
    unit = _TAGS.get(scalar.tag)
    radians = _number(scalar.text, unit) if unit is not None else None
    return scalar.value if radians is None else radians


def _number(text: str, unit: _Unit) -> float | None:
    try:
        return unit(float(evaluate(text.strip(), {"pi": math.pi})))
    except (ExpressionError, TypeError, ValueError):
        return None
