"""Names of the ROS graph: which are known, and which are written almost alike."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Final, Literal

Nearness = Literal["spelling", "typo", "namespace"]

_MARKS: Final = re.compile(r"[/_\-]")
_DIGITS: Final = re.compile(r"\d+")
_SHORTEST_TYPO: Final = 5
_LONGEST: Final = 120


def is_known(name: str) -> bool:
    """Whether no part of a name is computed while the robot runs; a pattern (`{hole}`) matches nothing."""
    return "{" not in name and bool(name.strip("/"))


class NearNames:
    """Finds names that are written almost like another one, without comparing all pairs."""

    def __init__(self, names: Iterable[str]) -> None:
        self._by_spelling: defaultdict[str, list[str]] = defaultdict(list)
        self._by_deletion: defaultdict[str, list[str]] = defaultdict(list)
        self._by_last: defaultdict[str, list[str]] = defaultdict(list)
        for name in sorted(set(names)):
            if len(name) > _LONGEST:
                continue
            self._by_spelling[_spelling(name)].append(name)
            self._by_last[_last(name)].append(name)
            for shorter in _deletions(name):
                self._by_deletion[shorter].append(name)

    def near(self, name: str) -> tuple[str, Nearness] | None:
        """The nearest other name and how it differs: spelling (`_`, case), a typo, or the namespace only."""
        if len(name) > _LONGEST:
            return None
        graded: tuple[tuple[Nearness, Iterable[str]], ...] = (
            ("spelling", self._by_spelling.get(_spelling(name), ())),
            ("typo", self._typos(name)),
            ("namespace", self._by_last.get(_last(name), ())),
        )
        for nearness, names in graded:
            for other in names:
                if other != name:
                    return other, nearness
        return None

    def _typos(self, name: str) -> Iterator[str]:
        for shorter in _deletions(name):
            for other in self._by_deletion.get(shorter, ()):
                if _is_typo(name, other):
                    yield other


def _spelling(name: str) -> str:
    return _MARKS.sub("", name).lower()


def _last(name: str) -> str:
    return name.rstrip("/").rpartition("/")[2]


def _deletions(name: str) -> Iterator[str]:
    """The name and all that lack one character of its last part: two of them meet where names differ by one."""
    if len(_last(name)) < _SHORTEST_TYPO:
        return
    yield name
    start = len(name.rstrip("/")) - len(_last(name))
    for at in range(start, len(name)):
        yield name[:at] + name[at + 1 :]


def _is_typo(one: str, two: str) -> bool:
    """One letter more, less, exchanged or swapped; numbers (`camera1`, `camera2`) are meant to differ."""
    if _DIGITS.sub("", one) == _DIGITS.sub("", two) or abs(len(one) - len(two)) > 1:
        return False
    if one + "s" == two or two + "s" == one:
        return True
    start = next((at for at, (a, b) in enumerate(zip(one, two, strict=False)) if a != b), min(len(one), len(two)))
    left, right = one[start:], two[start:]
    swapped = left[:2] == right[1::-1] and left[2:] == right[2:]
    return left[1:] == right[1:] or left[1:] == right or left == right[1:] or swapped
