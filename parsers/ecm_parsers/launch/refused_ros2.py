"""What the grammar of `launch` refuses in a text with `$(...)`.

Sources: `launch/share/launch/frontend/grammar.lark`; the classes that `expose_substitution` names in `launch` and
`launch_ros`.
"""

from __future__ import annotations

import re
from typing import Final

_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_-]*")
_OF_ROS_1: Final = frozenset({"arg", "find", "optenv"})
"""Names that no release of `launch` knows; others may come from an extension."""
_NEEDS_WORD: Final = frozenset({"var", "env", "find-pkg-share", "find-pkg-prefix", "find-exec", "eval", "command"})
_QUOTES: Final = "'\""


class _UnclosedError(Exception):
    """The text ends inside a substitution that began at `start`."""

    def __init__(self, start: int) -> None:
        super().__init__(start)
        self.start = start


class _WrongError(Exception):
    """A substitution is refused, whatever follows it."""


def problem_of_ros2(text: str) -> str | None:
    """Return the first thing that launch refuses, None where it takes the text."""
    try:
        _texts(text, 0, "")
    except _UnclosedError as found:
        return f"{_short(text[found.start :])} is never closed"
    except _WrongError as found:
        return str(found)
    except RecursionError:
        return None
    return None


def _texts(text: str, position: int, until: str) -> int:
    """Read text with substitutions up to a quote or the end, and return where it stops."""
    while position < len(text):
        if text[position] == "\\":
            position += 2
        elif text.startswith("$(", position):
            position = _substitution(text, position)
        elif text[position] == until:
            return position
        else:
            position += 1
    return position


def _substitution(text: str, start: int) -> int:
    """Read one substitution, and return the position behind it."""
    found = _IDENTIFIER.match(text, start + 2)
    if found is None:
        msg = f"{_short(text[start:])} has no name behind the parenthesis"
        raise _WrongError(msg)
    name = found[0]
    if name in _OF_ROS_1:
        msg = f"$({name} ...) is no substitution of ROS 2"
        raise _WrongError(msg)
    position = _words(text, found.end(), start)
    if name in _NEEDS_WORD and not text[found.end() : position - 1].strip():
        msg = f"$({name}) has no value and takes one"
        raise _WrongError(msg)
    return position


def _words(text: str, position: int, start: int) -> int:
    while position < len(text):
        here = text[position]
        if here == "\\":
            position += 2
        elif here == ")":
            return position + 1
        elif text.startswith("$(", position):
            position = _substitution(text, position)
        elif here in _QUOTES:
            position = _texts(text, position + 1, here) + 1
        else:
            position += 1
    raise _UnclosedError(start)


def _short(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= 60 else f"{line[:57]}..."
