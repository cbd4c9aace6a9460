"""Where a requirement stands, and what stands there."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.requirement import Requirement

Reader = Callable[[Iterable[str]], Iterator[tuple[str, bytes]]]
"""Yields path and content of files, in the order asked for."""


class Place(msgspec.Struct, frozen=True):
    """A line, and who requires there: `by` is `node talker`, `launch_file bringup.launch.py`, or a path.

    `column` is 1-based, None where it is not known.
    """

    path: str
    line: int
    by: str = ""
    column: int | None = None

    @property
    def evidence(self) -> tuple[Evidence, ...]:
        """The line as evidence."""
        return (Evidence(self.path, self.line, column=self.column),)


def required(use: str, name: str, place: Place, certainty: Certainty = "proved", **more: object) -> Requirement:
    """Return the requirement of a use at a place; its kind is the first that the use may mean.

    Args:
        use: a row of the vocabulary.
        name: that is used.
        place: where.
        certainty: how surely that name is meant.
        more: other fields of the requirement.
    """
    kind = uses()[use].of[0]
    base = Requirement(
        use=use,
        kind=kind,
        package=None,
        owner="",
        name=name,
        type=None,
        certainty=certainty,
        conditions=(),
        by=place.by,
        evidence=place.evidence,
    )
    return msgspec.structs.replace(base, **more) if more else base
