"""Angles as rosparam reads them: `!degrees 90`, `!radians pi/2`, `deg(90)` and `rad(pi/2)`, all in radians.

Source: wiki.ros.org/rosparam, "Radians and degrees".
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from ecm_parsers.expression import ExpressionError, evaluate
from ecm_parsers.yaml_tree import Scalar

_FACTORS: Final[Mapping[str, float]] = MappingProxyType({"!degrees": math.pi / 180.0, "!radians": 1.0})
_CALLS: Final[Mapping[str, float]] = MappingProxyType({"deg(": math.pi / 180.0, "rad(": 1.0})


def angle(scalar: Scalar) -> float | None:
    """Return the radians that a value means, None of one that is no angle."""
    text, factor = scalar.text.strip(), _FACTORS.get(scalar.tag)
    call = _CALLS.get(text[:4]) if text.endswith(")") else None
    if factor is None and (call is None or not isinstance(scalar.value, str) or scalar.tag):
        return None
    try:
        number = float(evaluate(text[4:-1] if call is not None else text, {"pi": math.pi}))
    except (ExpressionError, TypeError, ValueError):
        return None
    return number * (factor if factor is not None else call or 1.0)
