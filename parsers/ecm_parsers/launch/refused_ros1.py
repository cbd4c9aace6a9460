"""What roslaunch refuses in a text with `$(...)`: it knows no nesting, and `eval` as a whole text only.

Source: `roslaunch.substitution_args`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

_ANY: Final = 1_000
_NAMES: Mapping[str, tuple[int, int]] = MappingProxyType(
    {
        "find": (1, 1),
        "env": (1, 1),
        "optenv": (1, _ANY),
        "dirname": (0, _ANY),
        "anon": (1, 1),
        "arg": (1, 1),
    }
)
"""How many words each substitution takes, from and to."""
_EVAL: Final = "$(eval "
_LITERAL = re.compile(r"'(?:[^'\\]|\\.)*'|\"(?:[^\"\\]|\\.)*\"")


def problem_of_ros1(text: str) -> str | None:
    """Return the first thing that roslaunch refuses, or leaves as it is written; None where it takes the text."""
    if text.startswith(_EVAL) and text.endswith(")"):
        return _of_eval(text[len(_EVAL) : -1])
    position = 0
    while (start := text.find("$(", position)) >= 0:
        end = _end(text, start + 2)
        inner = text[start + 2 : end]
        if end == len(text):
            return f"{_short(text[start:])} is never closed"
        if text[end] != ")":
            return _nested(inner, text[start:])
        problem = _of_words(inner.split(" "))
        if problem is not None:
            return problem
        position = end + 1
    return None


def _end(text: str, position: int) -> int:
    """Where the first character stands that ends a substitution, or may not stand in one."""
    while position < len(text) and text[position] not in "$()":
        position += 1
    return position


def _nested(inner: str, text: str) -> str:
    if inner.startswith("eval"):
        return f"{_short(text)}: `eval` works only as the whole value"
    return f"{_short(text)}: roslaunch takes no `$` and no `(` inside a substitution"


def _of_words(found: list[str]) -> str | None:
    name, *words = [word for word in found if word] or [""]
    if name not in _NAMES:
        return f"$({_short(name)}) is no substitution of roslaunch" if name else None
    least, most = _NAMES[name]
    if least <= len(words) <= most:
        return None
    return f"$({_short(' '.join([name, *words]))}) has {len(words) or 'no'} values and takes {least}"


def _of_eval(code: str) -> str | None:
    """Python reads all of it, so a substitution inside is an error, or in quotes a text like any other."""
    if "$(" in _LITERAL.sub("", code):
        return f"{_short(code)}: there are no substitutions inside `eval`"
    return None


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 60 else f"{line[:57]}..."
