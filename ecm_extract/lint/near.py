"""Names that somebody may have meant."""

from __future__ import annotations

from collections.abc import Iterable
from difflib import SequenceMatcher, get_close_matches

from ecm_checker.finding import Rename

CUTOFF = 0.7
MAX_SLIP = 2
"""Letters by which a name that was mistyped differs: two where they are exchanged."""


def nearest(name: str, known: Iterable[str], cutoff: float = CUTOFF) -> str | None:
    """Return the known name that is most like another, at least `cutoff` of 1; None when none is."""
    found = get_close_matches(name, list(known), 1, cutoff)
    return found[0] if found else None


def slip(name: str, near: str | None) -> Rename | None:
    """Return the edit that mends a mistyped name; None where the near one may be another thing.

    Names that differ by their numbers, as those of two cameras do, are two things.
    """
    if not near or near == name or _digits(name) != _digits(near):
        return None
    parts = SequenceMatcher(None, name, near, autojunk=False).get_opcodes()
    differing = sum(max(end - start, to - at) for word, start, end, at, to in parts if word != "equal")
    return Rename(name, near) if differing <= MAX_SLIP else None


def _digits(name: str) -> str:
    return "".join(filter(str.isdigit, name))
