"""Sets of expressions, and the kinds of values that they ask for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any


class Members(list[Any]):
    """A set that keeps the order in which its members came, so that each run says the same."""

    def __init__(self, items: Iterable[Any] = ()) -> None:
        super().__init__(dict.fromkeys(items))

    def __sub__(self, other: Iterable[Any]) -> Members:
        without = list(other)
        return Members(item for item in self if item not in without)


KINDS: Mapping[str, type] = MappingProxyType(
    {kind.__name__: kind for kind in (str, int, float, bool, list, tuple, dict)} | {"set": Members}
)
"""Kinds of values by their names."""


def is_of(value: Any, kinds: type | tuple[type, ...]) -> bool:
    """Tell whether a value is of one of some kinds; a set is no list."""
    asked = kinds if isinstance(kinds, tuple) else (kinds,)
    return Members in asked if isinstance(value, Members) else isinstance(value, asked)
