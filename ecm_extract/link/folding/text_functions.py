"""Functions of libraries of C++ that give a text: what they make of what they are given.

Source: boost.org, String Algorithms; those without `_copy` change a text in place, as do algorithms of the C++ standard
that are read as these, see `cpp_writes`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType
from typing import Any, Final

from ecm_extract.infer.compute import UNKNOWN

_SPACE: Final = " \t\n\v\f\r"
_CHANGES: Final[Mapping[str, tuple[int, Callable[..., str]]]] = MappingProxyType(
    {
        "replace_all_copy": (3, lambda text, old, new: text.replace(old, new) if old else text),
        "replace_first_copy": (3, lambda text, old, new: text.replace(old, new, 1) if old else text),
        "erase_all_copy": (2, lambda text, old: text.replace(old, "") if old else text),
        "to_lower_copy": (1, str.lower),
        "to_upper_copy": (1, str.upper),
        "trim_copy": (1, lambda text: text.strip(_SPACE)),
        "trim_left_copy": (1, lambda text: text.lstrip(_SPACE)),
        "trim_right_copy": (1, lambda text: text.rstrip(_SPACE)),
    }
)


def _working(count: int, work: Callable[..., str]) -> Callable[[list[Any]], Any]:
    def found(data: list[Any]) -> Any:
        known = len(data) == count and all(isinstance(each, str) and each.isascii() for each in data)
        return work(*data) if known else UNKNOWN

    return found


TEXT_FUNCTIONS: Final[Mapping[str, Callable[[list[Any]], Any]]] = MappingProxyType(
    {f"{space}{name}": _working(*row) for name, row in _CHANGES.items() for space in ("boost::", "boost::algorithm::")}
)
"""What each gives of data that are known."""
