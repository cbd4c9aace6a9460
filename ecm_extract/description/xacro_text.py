"""Text of xacro files: `${expression}` and `$(substitution)` replaced by what they are.

Source: the xacro wiki page, "Math expressions", "Rospack commands".
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from ecm_extract.description.symbols import Symbols, Unknown

MAX_TEXT = 100_000
MAX_TOTAL = 8_000_000
MAX_DEPTH = 12
_LONGEST_NUMBER = 40
_DOLLARS = re.compile(r"(?P<signs>\$+)(?P<bracket>[{(]?)")
_TRUTH = {"true": True, "True": True, "false": False, "False": False}


class XacroText:
    """Evaluates the texts of one expansion.

    `expression` gives the value of `${...}`, `command` of `$(...)`; `problem` is told what cannot be read.
    """

    def __init__(
        self,
        expression: Callable[[str, Symbols], Any],
        command: Callable[[str, Symbols], Any],
        problem: Callable[[str], None],
    ) -> None:
        self._expression = expression
        self._command = command
        self._problem = problem
        self._depth = 0
        self._total = 0

    def value(self, text: str, symbols: Symbols) -> Any:
        """Return the value of a text: typed when it is one expression or a literal, else text."""
        pieces = self._pieces(text, symbols)
        return typed(pieces[0] if len(pieces) == 1 else self._joined(pieces))

    def text(self, text: str, symbols: Symbols) -> str | Unknown:
        """Return a text with everything in it evaluated."""
        return self._joined(self._pieces(text, symbols)) if "$" in text else text

    def shown(self, text: str, symbols: Symbols) -> str:
        """Return a text with everything in it evaluated; what is not known stands in braces."""
        return str(self.text(text, symbols))

    def _joined(self, pieces: list[Any]) -> str | Unknown:
        joined = "".join(str(piece) for piece in pieces)
        self._total += len(joined)
        if len(joined) > MAX_TEXT:
            self._problem(f"this text grows to {len(joined)} characters and is not read; shorten it")
            return Unknown("{...}")
        if self._total > MAX_TOTAL:
            self._problem("the texts of the description grow too long; the rest is not read")
            return Unknown("{...}")
        return Unknown(joined) if any(isinstance(piece, Unknown) for piece in pieces) else joined

    def _pieces(self, text: str, symbols: Symbols) -> list[Any]:
        if self._depth > MAX_DEPTH or len(text) > MAX_TEXT:
            self._problem("substitutions nest too deeply or are too long to read; simplify them")
            return [Unknown("{...}")]
        self._depth += 1
        try:
            return self._split(text, symbols)
        finally:
            self._depth -= 1

    def _split(self, text: str, symbols: Symbols) -> list[Any]:
        pieces: list[Any] = []
        position = 0
        while (dollars := _DOLLARS.search(text, position)) is not None:
            pieces.append(text[position : dollars.start()])
            position = self._dollar(text, dollars, symbols, pieces)
        return [piece for piece in (*pieces, text[position:]) if piece != ""] or [""]

    def _dollar(self, text: str, dollars: re.Match[str], symbols: Symbols, pieces: list[Any]) -> int:
        """Read what begins with dollar signs, return where it ends."""
        opening = dollars["bracket"]
        if not opening or len(dollars["signs"]) > 1:  # `$${x}` is how xacro writes a plain `${x}`
            pieces.append(dollars[0][1:] if opening else dollars[0])
            return dollars.end()
        end = closing(text, dollars.end() - 1)
        if end < 0:
            self._problem(f"`{text[dollars.start() : dollars.start() + 60]}` is never closed; close the bracket")
            pieces.append(text[dollars.start() :])
            return len(text)
        inner = text[dollars.end() : end]
        pieces.append(self._expression(inner, symbols) if opening == "{" else self._command(inner, symbols))
        return end + 1


def typed(value: Any) -> Any:
    """Return what a property's text means: number, truth value or text; other values as they are."""
    if not isinstance(value, str):
        return value
    if len(value) > 1 and value[0] == value[-1] == "'":
        return value[1:-1]
    if "_" in value or len(value) > _LONGEST_NUMBER:
        return value
    for kind in (int, float):
        try:
            return kind(value)
        except ValueError:
            continue
    return _TRUTH.get(value, value)


def closing(text: str, position: int) -> int:
    """Return where the bracket that opens at a position closes, -1 for nowhere; quotes of expressions are skipped."""
    depth, quote = 0, ""
    for at in range(position, len(text)):
        char = text[at]
        if quote:
            quote = "" if char == quote else quote
        elif char in "\"'" and text[position] == "{":
            quote = char
        elif char in "({[":
            depth += 1
        elif char in ")}]":
            depth -= 1
            if depth == 0:
                return at
    return -1


def truth_of(value: Any) -> bool | None:
    """Return whether a condition holds, None for a value that is no truth value or not known."""
    if isinstance(value, Unknown):
        return None
    if isinstance(value, str):
        return {"true": True, "false": False, "": False}.get(value.strip().lower())
    return bool(value)
