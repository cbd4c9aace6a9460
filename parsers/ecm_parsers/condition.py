"""Conditions of package.xml format 3 (`$ROS_VERSION == 2 and $X != "a"`), evaluated without `eval`.

Source: REP 149. Values are compared as text; a variable that is not set is the empty text.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

MAX_LENGTH = 1_000
MAX_DEPTH = 50
_TOKEN = re.compile(r"""\s*(?:(==|!=|<=|>=|<|>|\(|\))|"([^"]*)"|'([^']*)'|(\$?[\w.-]+))""")
_COMPARE: Mapping[str, Callable[[str, str], bool]] = MappingProxyType(
    {
        "==": operator.eq,
        "!=": operator.ne,
        "<=": operator.le,
        ">=": operator.ge,
        "<": operator.lt,
        ">": operator.gt,
    }
)


def evaluate(condition: str | None, variables: Mapping[str, str]) -> bool | None:
    """Evaluate a condition.

    Args:
        condition: its text; None, as for an element without the attribute, holds.
        variables: values by name without `$`, e.g. `ROS_VERSION`.

    Returns:
        Whether it holds, or None when it is no condition.
    """
    if condition is None:
        return True
    tokens = _tokens(condition[: MAX_LENGTH + 1])
    if tokens is None or len(condition) > MAX_LENGTH:
        return None
    reader = _Reader(tokens, variables)
    try:
        value = reader.either(0)
    except _NotAConditionError:
        return None
    return value if reader.at_end() else None


class _NotAConditionError(Exception):
    """The tokens do not follow the grammar."""


def _tokens(text: str) -> list[tuple[str, str]] | None:
    """Return (kind, text) pairs, kind `op`, `text` or `word`; None when a character fits nowhere."""
    tokens: list[tuple[str, str]] = []
    position = 0
    text = text.rstrip()
    while position < len(text):
        match = _TOKEN.match(text, position)
        if match is None:
            return None
        position = match.end()
        mark, double, single, word = match.groups()
        quoted = double if double is not None else single
        tokens.append(("op", mark) if mark else ("text", quoted) if quoted is not None else ("word", word))
    return tokens


class _Reader:
    """Reads `or` over `and` over comparisons, from left to right."""

    def __init__(self, tokens: list[tuple[str, str]], variables: Mapping[str, str]) -> None:
        self._tokens = tokens
        self._next = 0
        self._variables = variables

    def at_end(self) -> bool:
        return self._next == len(self._tokens)

    def either(self, depth: int) -> bool:
        value = self._both(depth)
        while self._skip(("word", "or")):
            right = self._both(depth)
            value = value or right
        return value

    def _both(self, depth: int) -> bool:
        value = self._single(depth)
        while self._skip(("word", "and")):
            right = self._single(depth)
            value = value and right
        return value

    def _single(self, depth: int) -> bool:
        if not self._skip(("op", "(")):
            return self._comparison()
        if depth >= MAX_DEPTH:
            raise _NotAConditionError
        value = self.either(depth + 1)
        if not self._skip(("op", ")")):
            raise _NotAConditionError
        return value

    def _comparison(self) -> bool:
        left = self._value()
        kind, mark = self._take()
        if kind != "op" or mark not in _COMPARE:
            raise _NotAConditionError
        return _COMPARE[mark](left, self._value())

    def _value(self) -> str:
        kind, text = self._take()
        if kind == "op" or (kind == "word" and text in ("and", "or")):
            raise _NotAConditionError
        if kind == "word" and text.startswith("$"):
            return self._variables.get(text[1:], "")
        return text

    def _take(self) -> tuple[str, str]:
        if self.at_end():
            raise _NotAConditionError
        self._next += 1
        return self._tokens[self._next - 1]

    def _skip(self, token: tuple[str, str]) -> bool:
        found = not self.at_end() and self._tokens[self._next] == token
        self._next += found
        return found
