"""Names that somebody may have meant."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import get_close_matches

CUTOFF = 0.7


def nearest(name: str, known: Iterable[str], cutoff: float = CUTOFF) -> str | None:
    """Return the known name that is most like another, at least `cutoff` of 1; None when none is."""
    found = get_close_matches(name, list(known), 1, cutoff)
    return found[0] if found else None
