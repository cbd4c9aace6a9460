"""The forms of a language, read from data: what a drawn program may say, and how it is written.

A file has a table for each symbol, with the forms of each idea (ideas.toml). A form is one or more lines. In a line,

* `$a_KIND` is a name in sight of that kind, `$any_KIND` one that may also be `read_KIND` (not to be changed),
  `$other_KIND` another one; `$new` and `$new2` are names that nothing else has. A form says the same name throughout;
* `$SYMBOL` is a form of that symbol, drawn anew at each place; `$short` and `$simple` are a `$text` of little depth;
* `@draw SYMBOL` stands for the lines of a form;
* `@block SYMBOL KIND=NAME,NAME` does so in a block, where these names are in sight too; the symbol `body` is a few
  statements, one publisher at least;
* `@declare KIND=NAME` brings names in sight, to the end of the block.

The table `SYMBOL_of_node` has further forms of a symbol, for where members of a node are in sight.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

HOLE = re.compile(r"\$(?:\{([a-z_0-9]+)\}|([a-z_0-9]+))")
FOLDER = Path(__file__).parent
OF_NODE = "_of_node"
NAMED = ("a", "any", "other")


@dataclass(frozen=True)
class Need:
    """A name that a form asks for: one that is in sight."""

    which: str
    kind: str

    @property
    def kinds(self) -> tuple[str, ...]:
        return (self.kind, f"read_{self.kind}") if self.which == "any" else (self.kind,)


@dataclass(frozen=True)
class Form:
    """One way to write a symbol."""

    idea: str
    text: str

    @cached_property
    def lines(self) -> tuple[str, ...]:
        return tuple(line for line in self.text.split("\n") if line.strip())

    @cached_property
    def nests(self) -> bool:
        return "@block body" in self.text

    @cached_property
    def needs(self) -> tuple[Need, ...]:
        found = (need_of(hole) for hole in holes(self.text))
        return tuple(dict.fromkeys(need for need in found if need))


def holes(text: str) -> Iterator[str]:
    """The names of the holes of a text, in their order."""
    for match in HOLE.finditer(text):
        yield match[1] or match[2]


def need_of(hole: str) -> Need | None:
    """The name that a hole asks for, nothing for a symbol."""
    which, _, kind = hole.partition("_")
    return Need(which, kind) if which in NAMED and kind else None


@dataclass(frozen=True)
class Grammar:
    """The forms of one language, and how often each idea is drawn."""

    forms: Mapping[str, tuple[Form, ...]]
    shares: Mapping[str, int]

    def of(self, symbol: str, inside_node: bool) -> tuple[Form, ...]:
        """The forms of a symbol.

        Raises:
            KeyError: no file has the symbol.
        """
        return self.forms[symbol] + (self.forms.get(symbol + OF_NODE, ()) if inside_node else ())


def grammar(language: str) -> Grammar:
    """Read the grammar of a language: `cpp` or `python`.

    Raises:
        OSError: there is no file of that language.
    """
    tables: dict[str, dict[str, list[str]]] = {**_read("shared"), **_read(language)}
    return Grammar({symbol: tuple(_forms(ideas)) for symbol, ideas in tables.items()}, _read("ideas"))


def _read(name: str) -> dict[str, Any]:
    return tomllib.loads((FOLDER / f"{name}.toml").read_text("utf-8"))


def _forms(ideas: Mapping[str, list[str]]) -> Iterator[Form]:
    for idea, texts in ideas.items():
        yield from (Form(idea, text) for text in texts)
