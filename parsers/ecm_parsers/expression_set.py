"""Sets of expressions, and the kinds of values that they ask for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Any


class Members(list[Any]):
    """A set that keeps the order in which its members came, so that each run says the same."""

    def __init__(self, items: Iterable[Any] = ()) -> None:
        super().__init__(dict.fromkeys(items))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Members) and set(self) == set(other)

    def __ne__(self, other: object) -> bool:
        return not self == other

    __hash__ = None  # a list can change

    def __le__(self, other: list[Any]) -> bool:
        return set(self) <= set(other)

    def __lt__(self, other: list[Any]) -> bool:
        return set(self) < set(other)

    def __ge__(self, other: list[Any]) -> bool:
        return set(self) >= set(other)

    def __gt__(self, other: list[Any]) -> bool:
        return set(self) > set(other)

    def __sub__(self, other: Iterable[Any]) -> Members:
        return self.difference(other)

    def __and__(self, other: Iterable[Any]) -> Members:
        return self.intersection(other)

    def __or__(self, other: Iterable[Any]) -> Members:
        return self.union(other)

    def __xor__(self, other: Iterable[Any]) -> Members:
        second = Members(other)
        return self.difference(second).union(second.difference(self))

    def difference(self, *others: Iterable[Any]) -> Members:
        """Return the members that no other has."""
        without = {item for other in others for item in other}
        return Members(item for item in self if item not in without)

    def intersection(self, *others: Iterable[Any]) -> Members:
        """Return the members that each other has."""
        within = [set(other) for other in others]
        return Members(item for item in self if all(item in other for other in within))

    def union(self, *others: Iterable[Any]) -> Members:
        """Return the members of all."""
        return Members(item for items in (self, *others) for item in items)

    def issubset(self, other: Iterable[Any]) -> bool:
        """Tell whether the other has all members."""
        return set(self) <= set(other)

    def issuperset(self, other: Iterable[Any]) -> bool:
        """Tell whether all members of the other are here."""
        return set(self) >= set(other)

    def isdisjoint(self, other: Iterable[Any]) -> bool:
        """Tell whether no member is in both."""
        return set(self).isdisjoint(other)

    def copy(self) -> Members:
        """Return the same members."""
        return Members(self)


KINDS: Mapping[str, type] = MappingProxyType(
    {kind.__name__: kind for kind in (str, int, float, bool, list, tuple, dict)} | {"set": Members}
)
"""Kinds of values by their names."""


def kind_of(value: Any) -> type:
    """Return the kind of a value; a set is no list."""
    return type(value)


def is_of(value: Any, kinds: type | tuple[type, ...]) -> bool:
    """Tell whether a value is of one of some kinds; a set is no list."""
    asked = kinds if isinstance(kinds, tuple) else (kinds,)
    return Members in asked if isinstance(value, Members) else isinstance(value, asked)
