"""Numbers as texts spell them: only those that facts can carry, since a text may spell any."""

from __future__ import annotations

import math
from typing import Final

INT_MIN: Final = -(2**63)
INT_MAX: Final = 2**64 - 1
"""What msgpack can carry; no interface of a robot has a larger one."""
MAX_DIGITS: Final = 400
"""Longest text that is read as a number: a double with all its digits has fewer."""


def integer(text: str, base: int = 10) -> int | None:
    """Return the integer that a text spells in a base (0: by its prefix); None for no such text and beyond 64 bit."""
    try:
        value = int(text, base) if len(text) <= MAX_DIGITS else None
    except ValueError:
        return None
    return value if value is not None and INT_MIN <= value <= INT_MAX else None


def real(text: str) -> float | None:
    """Return the finite number that a text spells; None for no such text, for infinity and for nan."""
    try:
        value = float(text) if len(text) <= MAX_DIGITS else math.nan
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def truncated(value: float) -> int | None:
    """Return a number without its fraction; None where that is beyond 64 bit, or no number."""
    return int(value) if INT_MIN <= value <= INT_MAX else None
