"""What a look-up ends in."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Generic, TypeVar

T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class External:
    """A name that nothing of the tree declares where it is asked for; as far as is known qualified."""

    name: str


@dataclass(frozen=True, slots=True)
class Ambiguous(Generic[T]):
    """Several declarations, of which the sources do not show which one is meant."""

    symbols: tuple[T, ...]


def outcome(found: Iterable[T], name: str) -> T | Ambiguous[T] | External:
    """Return the one thing that was found, or how it was not one."""
    distinct = tuple(dict.fromkeys(found))
    if len(distinct) == 1:
        return distinct[0]
    return Ambiguous(distinct) if distinct else External(name)
