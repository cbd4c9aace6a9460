"""Lines of the files that findings stand in, as they were read."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import cache

from ecm_checker.contract import Evidence

from ecm_extract.report.places import Line


def source_lines(read: Callable[[str], bytes | None], elsewhere: Iterable[Evidence] = ()) -> Line:
    """Return what gives the text of a line.

    Args:
        read: gives a file of the tree by its path.
        elsewhere: places that lie in another tree, of which no line is shown.
    """
    strangers = frozenset(elsewhere)

    @cache
    def lines(path: str) -> list[str]:
        data = read(path)
        return [] if data is None else data.decode("utf-8", "replace").splitlines()

    def line(place: Evidence) -> str | None:
        found = [] if place in strangers else lines(place.path)
        return found[place.line - 1] if 0 < place.line <= len(found) else None

    return line
