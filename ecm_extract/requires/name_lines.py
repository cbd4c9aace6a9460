"""Lines of names: an element or call of several lines is told by the line that has the name."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Final

_REACH: Final = 12
"""Lines of one element or call that are looked through."""


def line_of_name(lines: Sequence[bytes], start: int, name: str) -> int:
    """Return the first line from `start` on that has a name as a whole word; `start` where none has it.

    Args:
        lines: of the file.
        start: 1-based line of the element or call.
        name: as it is written there.
    """
    word = re.compile(rb"(?<![\w.])" + re.escape(name.encode()) + rb"(?![\w.])")
    reach = lines[start - 1 : start - 1 + _REACH]
    return next((start + at for at, line in enumerate(reach) if word.search(line)), start)
