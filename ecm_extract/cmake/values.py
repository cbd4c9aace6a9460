"""What a variable of CMake may hold: one text, one of several, or what only the build machine knows.

A part that is not known is the name that stands for it between two marks; it is written `${NAME}` in facts.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Final

import msgspec

MAX_TEXTS: Final = 8
MAX_TEXT: Final = 30_000
_OPEN, _CLOSE = "\x01", "\x02"
_MARK: Final = re.compile(f"{_OPEN}([^{_OPEN}{_CLOSE}]*){_CLOSE}")
SOURCE: Final = "/\x03"
"""The root of the tree that is read, wherever that lies."""
BINARY: Final = "/\x04"
"""The folder of the build."""
PREFIX: Final = "/\x05"
"""The folder of installation."""
_PLACES: Final = frozenset("\x03\x04\x05")


class Value(msgspec.Struct, frozen=True):
    """What a variable may hold.

    Attributes:
        texts: the possible ones; None is a variable that is not set.
        sure: whether the first one is that of a build without settings of its own.
        cached: whether it is what the cache holds; a variable of a scope hides that.
    """

    texts: tuple[str | None, ...]
    sure: bool = True
    cached: bool = False

    @property
    def first(self) -> str | None:
        """The text of a build without settings, as far as that is known."""
        return self.texts[0]


def unknown(name: str) -> str:
    """Return a text that stands for what a name holds when a build runs."""
    return f"{_OPEN}{name}{_CLOSE}"


def is_known(text: str) -> bool:
    """Tell whether all of a text is known."""
    return _OPEN not in text


def is_placed(text: str) -> bool:
    """Tell whether a text holds a folder of the machine, so that its length and letters are not known."""
    return not _PLACES.isdisjoint(text)


def written(text: str) -> str:
    """Return a text with its unknown parts as references."""
    return _MARK.sub(r"${\1}", text) if _OPEN in text else text


def one_of(texts: Iterable[str | None], sure: bool) -> Value:
    """Return the value that is one of some texts, the first being that of a build without settings if `sure`."""
    kept = tuple(dict.fromkeys(text if text is None or len(text) <= MAX_TEXT else unknown("long") for text in texts))
    if len(kept) > MAX_TEXTS:
        kept = (*kept[: MAX_TEXTS - 1], unknown("many"))
    return Value(kept, sure or len(kept) == 1)


def joined(values: list[Value], has_default: bool) -> Value:
    """Return what a variable holds after paths have met; the first is that of a build without settings."""
    if all(value == values[0] for value in values):
        return values[0]
    return one_of((text for value in values for text in value.texts), has_default and values[0].sure)
