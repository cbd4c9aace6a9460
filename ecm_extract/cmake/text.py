"""References and escapes in the arguments of a command (cmake-language(7), "Command Arguments")."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Final

from ecm_parsers.cmake_tokens import Argument

from ecm_extract.cmake.lists import arguments
from ecm_extract.cmake.look import Look
from ecm_extract.cmake.values import MAX_TEXT, unknown

MAX_NESTING: Final = 8
_ESCAPES: Final = {"n": "\n", "t": "\t", "r": "\r"}
_PLAIN: Final = re.compile(r"[^$\\}]{1,1000}")
"""Text without references and escapes, a piece of it: how much is read is bounded."""
_STARTS: Final = (("${", ""), ("$ENV{", "ENV:"), ("$CACHE{", "CACHE:"))


class _Reader:
    """A cursor over one argument."""

    def __init__(self, text: str, get: Callable[[str], str | None]) -> None:
        self._text = text
        self._get = get
        self._at = 0

    def read(self, depth: int = 0) -> str:
        """Read to the end of the text, or of the reference that is open."""
        found: list[str] = []
        size = 0
        while self._at < len(self._text) and size <= MAX_TEXT:
            if depth and self._text[self._at] == "}":
                break
            found.append(self._part(depth))
            size += len(found[-1])
        return "".join(found)

    def _part(self, depth: int) -> str:
        text, at = self._text, self._at
        if text[at] == "\\" and at + 1 < len(text):
            self._at += 2
            following = text[at + 1]
            return "\\;" if following == ";" else _ESCAPES.get(following, following)
        start = next((each for each in _STARTS if text[at] == "$" and text.startswith(each[0], at)), None)
        if start is not None and depth < MAX_NESTING and "}" in text[at:]:
            self._at += len(start[0])
            name = self.read(depth + 1)
            self._at += 1
            return self._value(start[1] + name)
        plain = _PLAIN.match(text, at)
        self._at = plain.end() if plain is not None else at + 1
        return text[at : self._at]

    def _value(self, name: str) -> str:
        if name.startswith(("ENV:", "CACHE:")):
            return unknown(name.replace(":", "_"))
        return self._get(name) or ""


def expanded(text: str, get: Callable[[str], str | None]) -> str:
    """Return a text with its references replaced; what is not known is marked."""
    if "$" not in text and "\\" not in text:
        return text
    return _Reader(text, get).read()


def values(argument: Argument, get: Callable[[str], str | None]) -> list[str]:
    """Return what an argument stands for: several texts where it is unquoted and holds a list.

    Args:
        argument: of a command.
        get: gives the text of a variable.
    """
    if argument.form == "bracket":
        return [argument.text]
    text = expanded(argument.text, get)
    return [text] if argument.form == "quoted" else arguments(text)


def all_values(args: tuple[Argument, ...], look: Look) -> list[str]:
    """Return what all arguments of a command stand for."""
    return [value for argument in args for value in values(argument, look.substituted)]
