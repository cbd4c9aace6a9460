"""Comparisons of two texts, as conditions and generator expressions name them (cmake-commands(7), "if")."""

from __future__ import annotations

import re
from collections.abc import Callable
from itertools import zip_longest
from typing import Final

from ecm_extract.cmake.values import is_placed

NUMBER: Final = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_VERSION: Final = re.compile(r"[0-9]+")


def _numbers(compare: Callable[[float, float], bool]) -> Callable[[str, str], bool]:
    def run(one: str, other: str) -> bool:
        both_numbers = NUMBER.fullmatch(one) and NUMBER.fullmatch(other)
        return bool(both_numbers) and compare(float(one), float(other))

    return run


def _texts(compare: Callable[[str, str], bool]) -> Callable[[str, str], bool | None]:
    def run(one: str, other: str) -> bool | None:
        # Which of two folders of a machine comes first is not known.
        return (
            None
            if (is_placed(one) or is_placed(other)) and one != other and compare is not _same
            else compare(one, other)
        )

    return run


def _same(one: str, other: str) -> bool:
    return one == other


def _order(one: str, other: str) -> int:
    pairs = zip_longest(_components(one), _components(other), fillvalue=0)
    return next(((left > right) - (left < right) for left, right in pairs if left != right), 0)


def _components(text: str) -> list[int]:
    """Numbers of a version up to the first that is none."""
    found = []
    for part in text.split("."):
        match = _VERSION.match(part)
        if match is None:
            break
        found.append(int(match[0][:18]))
        if match.end() < len(part):
            break
    return found


def _versions(holds_for: Callable[[int], bool]) -> Callable[[str, str], bool]:
    return lambda one, other: holds_for(_order(one, other))


COMPARISONS: Final[dict[str, Callable[[str, str], bool | None]]] = {
    "EQUAL": _numbers(lambda one, other: one == other),
    "LESS": _numbers(lambda one, other: one < other),
    "GREATER": _numbers(lambda one, other: one > other),
    "LESS_EQUAL": _numbers(lambda one, other: one <= other),
    "GREATER_EQUAL": _numbers(lambda one, other: one >= other),
    "STREQUAL": _texts(_same),
    "STRLESS": _texts(lambda one, other: one < other),
    "STRGREATER": _texts(lambda one, other: one > other),
    "STRLESS_EQUAL": _texts(lambda one, other: one <= other),
    "STRGREATER_EQUAL": _texts(lambda one, other: one >= other),
    "PATH_EQUAL": _texts(_same),
    "VERSION_EQUAL": _versions(lambda order: order == 0),
    "VERSION_LESS": _versions(lambda order: order < 0),
    "VERSION_GREATER": _versions(lambda order: order > 0),
    "VERSION_LESS_EQUAL": _versions(lambda order: order <= 0),
    "VERSION_GREATER_EQUAL": _versions(lambda order: order >= 0),
    "IS_NEWER_THAN": lambda one, other: None,
    "MATCHES": lambda one, other: None,
    "IN_LIST": lambda one, other: None,
}
"""None is not known from the texts alone."""
