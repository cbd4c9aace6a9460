"""One place that depends on an entity that changed."""

from __future__ import annotations

import msgspec
from ecm_checker.finding import Certainty

from ecm_extract.diff.model import Located


class Use(msgspec.Struct, frozen=True):
    """A consumer's line that a change breaks, or soon will.

    Attributes:
        located: the change. package: of the consumer.
        path, line, column: where, the column 0 where it is not known.
        commit: of the tree that was read, None in a work tree.
        what: what the line does, as a phrase.
        certainty: `proved` when names are literal and resolved, `likely` when they match by their end.
        remapped: a launch file keeps the old name alive.
        kept_for: the distribution that the file is kept for, beside one for the others; empty for none.
    """

    located: Located
    package: str
    path: str
    line: int
    commit: str | None
    what: str
    certainty: Certainty = "proved"
    remapped: bool = False
    kept_for: str = ""
    column: int = 0


class Place(msgspec.Struct, frozen=True):
    """Where a use stands."""

    package: str
    path: str
    line: int
    column: int = 0


def use_at(located: Located, place: Place, what: str, certainty: Certainty = "proved") -> Use:
    """Return the use of a change at a place; the tree's commit is filled in by the collector."""
    return Use(located, place.package, place.path, place.line, None, what, certainty, column=place.column)
