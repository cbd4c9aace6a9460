"""What braces and parentheses give a container of C++: the list of its elements, or what its constructor takes."""

from __future__ import annotations

from typing import Final

from ecm_parsers.source.expr import Expr, Items

_CONTAINERS: Final = frozenset(
    {
        "array", "deque", "forward_list", "initializer_list", "list", "map", "multimap", "multiset", "queue", "set",
        "span", "stack", "unordered_map", "unordered_multimap", "unordered_multiset", "unordered_set", "vector",
    }
)  # fmt: skip
"""en.cppreference.com, containers library."""
_ARRAY: Final = "array"


def holds_several(name: str) -> bool:
    """Tell whether a type is a container: one value in braces is its first element, and not what begins as that."""
    return name.rpartition("::")[2] in _CONTAINERS


def given(name: str, args: tuple[Expr, ...], braces: bool) -> tuple[Expr, ...]:
    """Return what an object of a type is made from: in braces a container gets one list of what it holds.

    The elements of an array can stand in braces of their own, which are those of the array within it.
    """
    if not args or not braces or not holds_several(name):
        return args
    inner = len(args) == 1 and isinstance(args[0], Items) and name.rpartition("::")[2] == _ARRAY
    return args if inner else (Items(args),)
