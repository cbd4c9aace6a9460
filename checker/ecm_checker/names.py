"""Names of the ROS graph: which are known, and which are written almost alike."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable
from functools import lru_cache
from typing import Final, Literal, NamedTuple

Nearness = Literal["spelling", "typo", "namespace"]

_MARKS: Final = re.compile(r"[/_\-]")
_DIGITS: Final = re.compile(r"\d+")
_SHORTEST_TYPO: Final = 5
_LONGEST: Final = 120


def is_known(name: str) -> bool:
    """Whether a name is the same for everybody.

    A pattern (`{hole}`) is computed while the robot runs, and `~` stands for the name of a node that is not known:
    neither matches anything.
    """
    return "{" not in name and "~" not in name and bool(name.strip("/"))


class NearNames:
    """Finds names that are written almost like another one, without comparing all pairs."""

    def __init__(self, names: Iterable[str]) -> None:
        self._by_spelling: dict[str, str] = {}
        self._by_last: dict[str, str] = {}
        self._by_deletion: defaultdict[str, list[str]] = defaultdict(list)
        for name in sorted(names):
            keys = _keys(name)
            self._by_spelling.setdefault(keys.spelling, name)
            self._by_last.setdefault(keys.last, name)
            for shorter in keys.deletions:
                self._by_deletion[shorter].append(name)

    def near(self, name: str) -> tuple[str, Nearness] | None:
        """The nearest of the names and how it differs: spelling (`_`, case), a typo, or the namespace only.

        Args:
            name: none of the names themselves.
        """
        keys = _keys(name)
        other = self._by_spelling.get(keys.spelling)
        if other is not None:
            return other, "spelling"
        for shorter in keys.deletions:
            for other in self._by_deletion.get(shorter, ()):
                if _is_typo(name, other):
                    return other, "typo"
        other = self._by_last.get(keys.last)
        return (other, "namespace") if other is not None else None


def near_keys(names: Iterable[str]) -> frozenset[str]:
    """Keys such that two sets of names without a common one hold no near names."""
    return frozenset(key for name in names for key in (_keys(name).spelling, _keys(name).last, *_keys(name).deletions))


class _Keys(NamedTuple):
    """What near names have in common: their letters, their last part, or the rest when a letter is left out."""

    spelling: str
    last: str
    deletions: tuple[str, ...]


@lru_cache(maxsize=65_536)
def _keys(name: str) -> _Keys:
    bare = name.rstrip("/")
    last = bare.rpartition("/")[2]
    return _Keys(_MARKS.sub("", name).lower(), last, _deletions(bare, len(bare) - len(last)))


def _deletions(name: str, start: int) -> tuple[str, ...]:
    """The name and all that lack one character of its last part: two of them meet where names differ by one.

    Digits stay: numbered names are meant to differ.
    """
    if not _SHORTEST_TYPO <= len(name) - start <= _LONGEST:
        return ()
    return (name, *(name[:at] + name[at + 1 :] for at in range(start, len(name)) if not name[at].isdigit()))


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
