"""Values of parameters as JSON can hold them: what it has no number for is the text that YAML writes."""

from __future__ import annotations

import math
from typing import Any

_LARGEST = 1 << 63
"""Of the integers that ROS parameters and readers of JSON hold."""


def json_value(value: Any) -> Any:
    """Return plain data of which JSON loses nothing; a value of no plain type is its text."""
    if isinstance(value, dict):
        return {str(key): json_value(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [json_value(item) for item in value]
    if isinstance(value, float) and not math.isfinite(value):
        return ".nan" if math.isnan(value) else ".inf" if value > 0 else "-.inf"
    if isinstance(value, int) and not -_LARGEST <= value < _LARGEST:
        return str(value)
    return value if value is None or type(value) in {bool, int, float, str} else str(value)
