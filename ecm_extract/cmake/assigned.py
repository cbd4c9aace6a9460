"""Variables that a file sets somewhere: where none of these commands ran, such a variable is empty."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Final

from ecm_parsers.cmake_tokens import Command

_GROWING: Final = frozenset({"APPEND", "PREPEND", "INSERT"})


def assigned(commands: Iterable[Command]) -> Iterator[str]:
    """Yield names that `set` and `list` write to as they are; those of the cache are for who builds to set."""
    for command in commands:
        words = [argument.text for argument in command.args]
        if command.name == "set" and words and "CACHE" not in words:
            names = words[:1]
        else:
            names = words[1:2] if command.name == "list" and words[:1] and words[0] in _GROWING else []
        yield from (name for name in names if "$" not in name)
