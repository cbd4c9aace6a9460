"""Many values of one query: as many as every database takes at once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import islice
from typing import Final, TypeVar

_AT_ONCE: Final = 5000
_Item = TypeVar("_Item")


def grouped(items: Sequence[_Item]) -> Iterator[list[_Item]]:
    """Yield items in groups as one query can name them."""
    rest = iter(items)
    while group := list(islice(rest, _AT_ONCE)):
        yield group
