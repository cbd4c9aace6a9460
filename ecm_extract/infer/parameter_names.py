"""By which parameter a function has an argument; `*rest` and `**named` of Python have several, under their mark."""

from __future__ import annotations

from collections.abc import Sequence

from ecm_parsers.source.facts import Parameter


def name_at(place: int, parameters: Sequence[Parameter]) -> str:
    """Return the name of the parameter that has the argument of a place, empty for none."""
    placed = [entry.name for entry in parameters if not entry.name.startswith("**")]
    rest = next((name for name in placed[: place + 1] if name.startswith("*")), "")
    return rest or (placed[place] if place < len(placed) else "")


def name_for(keyword: str, parameters: Sequence[Parameter]) -> str:
    """Return the name of the parameter that has an argument which is given by its name."""
    known = any(entry.name == keyword for entry in parameters)
    return keyword if known else next((entry.name for entry in parameters if entry.name.startswith("**")), keyword)
