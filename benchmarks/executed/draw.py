"""Draws a program of a grammar: which forms follow each other, what is in sight of each, how deep they nest."""

from __future__ import annotations

import random
from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TypeVar

from executed.grammar import HOLE, Form, Grammar, Need, need_of

STATEMENTS = 14
OUTERMOST = 2
NESTED = OUTERMOST + 3
DEPTHS = {"text": 3, "short": 1, "simple": 0}
"""Holes of texts, and how many texts one may hold within each other."""
_T = TypeVar("_T")


@dataclass
class Names:
    """Names in sight, by what they hold."""

    kinds: dict[str, list[str]] = field(default_factory=lambda: defaultdict(list))

    def copy(self) -> Names:
        copied = Names()
        for kind, names in self.kinds.items():
            copied.kinds[kind] = list(names)
        return copied

    def told(self, words: Sequence[str]) -> None:
        """Bring names in sight that are written `KIND=NAME,NAME`."""
        for word in words:
            kind, _, names = word.partition("=")
            self.kinds[kind] += names.split(",")

    def of(self, need: Need) -> list[str]:
        return [name for kind in need.kinds for name in self.kinds[kind]]

    def have(self, need: Need) -> bool:
        return len(self.of(need)) > (1 if need.which == "other" else 0)


@dataclass
class Filling:
    """One form that is being written: its names, and how deep its texts may go."""

    depth: int
    chosen: dict[str, str] = field(default_factory=dict)


class Program:
    """One program, the same for the same seed."""

    def __init__(self, seed: str, grammar: Grammar, space: str = "drawn") -> None:
        self.ideas: Counter[str] = Counter()
        self._random = random.Random(seed)
        self._grammar = grammar
        self._names = Names()
        self._names.told([f"space={space}"])
        self._lines: list[str] = []
        self._made = 0
        self._left = STATEMENTS
        self._nested = 0

    def source(self) -> str:
        """Draw the program; to be asked for once."""
        self._write("program", "")
        return "\n".join(self._lines) + "\n"

    # --- lines ---------------------------------------------------------------------------------------------

    def _write(self, symbol: str, indent: str) -> None:
        form, filling = self._form(symbol), Filling(DEPTHS["text"])
        for line in form.lines:
            text = line.lstrip(" ")
            self._line(text, indent + " " * (len(line) - len(text)), filling)

    def _line(self, text: str, indent: str, filling: Filling) -> None:
        directive, *words = self._fill(text, filling).split(" ")
        if directive == "@declare":
            self._names.told(words)
        elif directive == "@block":
            self._block(words[0], words[1:], indent)
        elif directive == "@draw":
            self._write(words[0], indent)
        elif directive:
            self._lines.append(indent + " ".join([directive, *words]))

    def _block(self, symbol: str, told: Sequence[str], indent: str) -> None:
        """The lines of a symbol; what is declared inside is not in sight after it."""
        before, self._names = self._names, self._names.copy()
        self._names.told(told)
        self._nested += 1
        if symbol == "body":
            self._body(indent)
        else:
            self._write(symbol, indent)
        self._nested -= 1
        self._names = before

    def _body(self, indent: str) -> None:
        """Statements, and at least one publisher."""
        before = len(self._lines)
        for _ in range(self._random.randint(1, STATEMENTS if self._nested <= OUTERMOST else 3)):
            if self._left > 0:
                self._left -= 1
                self._write("statement", indent)
        if len(self._lines) == before:
            self._write("publish", indent)

    # --- one form ------------------------------------------------------------------------------------------

    def _form(self, symbol: str) -> Form:
        """A form of a symbol that can stand here: first its idea is drawn, then one of its forms."""
        members = bool(self._names.kinds["member"])
        ideas: dict[str, list[Form]] = defaultdict(list)
        for form in self._grammar.of(symbol, members):
            if self._possible(form):
                ideas[form.idea].append(form)
        shares = [self._grammar.shares[idea] for idea in ideas]
        idea = self._random.choices(list(ideas), shares)[0]
        self.ideas[idea] += 1
        return self._one(ideas[idea])

    def _possible(self, form: Form) -> bool:
        return all(map(self._names.have, form.needs)) and not (form.nests and self._nested >= NESTED)

    def _fill(self, text: str, filling: Filling) -> str:
        return HOLE.sub(lambda match: self._filled(match[1] or match[2], filling), text)

    def _filled(self, hole: str, filling: Filling) -> str:
        if hole in DEPTHS:
            return self._text(min(filling.depth, DEPTHS[hole]))
        need = need_of(hole)
        if not need and not hole.startswith("new"):
            return self._phrase(hole, filling.depth)
        if hole not in filling.chosen:
            filling.chosen[hole] = self._named(need, filling) if need else self._fresh()
        return filling.chosen[hole]

    def _named(self, need: Need, filling: Filling) -> str:
        others = filling.chosen.get(f"a_{need.kind}") if need.which == "other" else None
        return self._one([name for name in self._names.of(need) if name != others])

    def _text(self, depth: int) -> str:
        deep = depth > 0 and self._random.random() > 0.25
        return self._phrase("text" if deep else "simple", depth - 1)

    def _phrase(self, symbol: str, depth: int) -> str:
        return self._fill(self._form(symbol).text, Filling(depth))

    def _fresh(self) -> str:
        self._made += 1
        return f"name{self._made}"

    def _one(self, options: Sequence[_T]) -> _T:
        return self._random.choice(options)
