"""Conditions of build files, as `ecm_extract.cmake` leaves them undecided, in the form that documents hold."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

from ecm_checker.hub.condition import Condition

_AND: Final = " AND "
_OR: Final = " OR "
_NOT: Final = "NOT "


def build_conditions(texts: Iterable[str]) -> tuple[Condition, ...]:
    """Return conditions as CMake writes them by what they test; an option that is tested alone by its name."""
    return tuple(dict.fromkeys(each for text in texts for each in _of(text)))


def _of(text: str) -> Iterator[Condition]:
    parts = text.split(_AND) if _OR not in text else [text]
    if not all(part.count("(") == part.count(")") for part in parts):
        parts = [text]
    yield from (_tested(part.strip()) for part in parts)


def _tested(part: str) -> Condition:
    if part.startswith(_NOT):
        inner = part.removeprefix(_NOT).strip()
        bare = inner[1:-1].strip() if inner.startswith("(") and inner.endswith(")") else inner
        if _is_option(bare):
            return Condition("option", bare, negated=True)
    return Condition("option" if _is_option(part) else "expression", part)


def _is_option(text: str) -> bool:
    return text.isidentifier()
