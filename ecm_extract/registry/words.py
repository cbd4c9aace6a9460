"""The words of names: `/nav2/cmd_vel_smoothed` and `NavigateToPose` as people search for them."""

from __future__ import annotations

import re
from typing import Final

_PIECE: Final = re.compile(r"[^\W_]+")
_HUMP: Final = re.compile(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")


def words_of(name: str) -> list[str]:
    """Return the words of a name in their order, in small letters."""
    return [word.lower() for piece in _PIECE.findall(name) for word in _HUMP.split(piece)]


def searched_words(name: str) -> str:
    """Return the words by which a name is found, also those that stand together without a mark: `navigatetopose`."""
    words = words_of(name)
    whole = [piece.lower() for piece in _PIECE.findall(name)]
    return " ".join((*words, *(each for each in dict.fromkeys(whole) if each not in words)))
