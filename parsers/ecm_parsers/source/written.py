"""What a source has besides comments: its names, and its texts."""

from __future__ import annotations

from typing import NamedTuple


class Written(NamedTuple):
    """A name or a text of a source, with its 1-based line."""

    value: str
    line: int
