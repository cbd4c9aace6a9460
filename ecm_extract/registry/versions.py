"""Order of versions, in Python and in a database."""

from __future__ import annotations

import re
from typing import Final

_NUMBERS: Final = re.compile(r"\d+")
_PRE: Final = re.compile(r"(?:^|[^a-z])(a|alpha|b|beta|c|rc|pre|preview|dev)(?:[^a-z]|$)", re.IGNORECASE)
_PARTS: Final = 6
_DIGITS: Final = 12


def rank(version: str) -> str:
    """Return text that sorts as versions do: by numbers, a pre-release before its release.

    The text itself is its end, so that two versions never rank alike.
    """
    head = _PRE.search(version)
    final, rest = (version[: head.start()], version[head.start() :]) if head else (version, "")
    numbers = [_padded(each) for each in _NUMBERS.findall(final)[:_PARTS]]
    numbers += [_padded("0")] * (_PARTS - len(numbers))
    tail = f"0{''.join(_padded(each) for each in _NUMBERS.findall(rest))}" if head else "1"
    return f"{'.'.join(numbers)}.{tail} {version}"


def _padded(number: str) -> str:
    return number.lstrip("0").rjust(_DIGITS, "0")[-_DIGITS:]
