"""Random choices of one program, and the lines that it is made of."""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TypeVar

WORDS = ("scan", "odom", "cmd", "left", "right", "arm", "base", "image", "map", "goal")
_T = TypeVar("_T")


@dataclass
class Names:
    """Variables that are in sight, by what they hold."""

    texts: list[str] = field(default_factory=list)
    numbers: list[str] = field(default_factory=list)
    lists: list[str] = field(default_factory=list)
    tables: list[str] = field(default_factory=list)

    def copy(self) -> Names:
        return Names(list(self.texts), list(self.numbers), list(self.lists), list(self.tables))


class Draw:
    """Draws one program; subclasses know a language."""

    def __init__(self, seed: str) -> None:
        self.random = random.Random(seed)
        self.lines: list[str] = []
        self.indent = 0
        self.names = Names()
        self.count = 0
        self.left = 14
        self.nested = 0

    def add(self, line: str) -> None:
        self.lines.append("    " * self.indent + line)

    def fresh(self, stem: str) -> str:
        self.count += 1
        return f"{stem}{self.count}"

    def word(self) -> str:
        return self.random.choice(WORDS)

    def small(self) -> int:
        return self.random.randrange(4)

    def one(self, options: Sequence[_T]) -> _T:
        return self.random.choice(options)

    def chance(self, share: float) -> bool:
        return self.random.random() < share

    @contextmanager
    def block(self) -> Iterator[None]:
        """What is declared inside is not in sight after it."""
        before = self.names
        self.names = before.copy()
        self.indent += 1
        self.nested += 1
        yield
        self.nested -= 1
        self.indent -= 1
        self.names = before

    def statements(self, forms: Sequence[Callable[[], None]], most: int) -> None:
        for _ in range(self.random.randint(1, most)):
            if self.left <= 0:
                return
            self.left -= 1
            self.one(forms)()
