"""One reading of variables: where one may hold several texts, the same is done again with each of the others."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Final, Generic, TypeVar

import msgspec

from ecm_extract.cmake.outside import Outside
from ecm_extract.cmake.values import Value, unknown

MAX_WORLDS: Final = 8
Result = TypeVar("Result")


class Outcomes(msgspec.Struct, Generic[Result], frozen=True):
    """What something gives: first as a build without settings has it (if `sure`), then with other texts."""

    first: Result
    others: tuple[Result, ...]
    sure: bool
    reads: frozenset[str]


class Look:
    """Variables as one of the possible worlds has them; it remembers which of several texts were asked for."""

    def __init__(self, scope: Mapping[str, Value], chosen: Mapping[str, str | None], outside: Outside) -> None:
        self._scope = scope
        self._chosen = chosen
        self._outside = outside
        self.several: dict[str, None] = {}
        self.sure = True

    def get(self, name: str) -> str | None:
        """Return the text of a variable, None of one that is not set; what nothing of the tree sets is unknown."""
        value = self._scope.get(name)
        if value is None:
            return unknown(name)
        if name in self._chosen:
            return self._chosen[name]
        if len(value.texts) > 1:
            self.several[name] = None
            self.sure = self.sure and value.sure
        return value.first

    def outside(self, name: str) -> bool:
        """Tell whether a variable may be set by what is not read."""
        return self._outside.may_set(name)

    def substituted(self, name: str) -> str | None:
        """Return the text that a reference stands for; what only the tree sets, and has not, is empty."""
        if name not in self._scope and self._outside.leaves_empty(name):
            return None
        return self.get(name)

    def is_cached(self, name: str) -> bool:
        """Tell whether a variable shows what the cache holds."""
        return name in self._scope and self._scope[name].cached

    def is_told(self, name: str) -> bool:
        """Tell whether a build is told a variable that nothing of the tree sets; one without settings is not."""
        if name not in self._chosen:
            self.several[name] = None
        return name in self._chosen

    def has(self, name: str) -> bool:
        """Tell whether the tree sets or unsets a variable at all."""
        return name in self._scope

    def built_up(self, name: str) -> str:
        """Return the text of a list that a file adds to: one that nothing set before is empty, unless others set it."""
        if name not in self._scope and not self.outside(name):
            return ""
        return self.get(name) or ""


def worlds(scope: Mapping[str, Value], outside: Outside, run: Callable[[Look], Result]) -> Outcomes[Result]:
    """Run something with the first texts, then again with each other text of what it asked for."""
    look = Look(scope, {}, outside)
    first = run(look)
    others = [run(Look(scope, chosen, outside)) for chosen in _choices(scope, look)]
    return Outcomes(first, tuple(others), look.sure, frozenset(look.several))


def _choices(scope: Mapping[str, Value], look: Look) -> Iterator[Mapping[str, str | None]]:
    count = 1
    for name in look.several:
        for text in scope[name].texts[1:] if name in scope else (unknown(name),):
            if count < MAX_WORLDS:
                count += 1
                yield {name: text}
