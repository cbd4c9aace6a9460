"""One line of a consumer that a change breaks, or soon will."""

from __future__ import annotations

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty
from ecm_checker.hub.requirement import Requirement

from ecm_extract.diff.model import Located


class Use(msgspec.Struct, frozen=True):
    """A consumer's line and the change that concerns it.

    Attributes:
        located: the change. package: of the consumer.
        requirement: what the line depends on. at: the line.
        commit: of the tree that was read, None in a work tree.
        what: what the line does, as a phrase.
        certainty: `proved` when names are literal and resolved, `likely` when they match by their end.
        remapped: a launch file keeps the old name alive.
    """

    located: Located
    package: str
    requirement: Requirement
    at: Evidence
    commit: str | None
    what: str
    certainty: Certainty = "proved"
    remapped: bool = False

    @property
    def path(self) -> str:
        """Of the line."""
        return self.at.path

    @property
    def line(self) -> int:
        """1-based."""
        return self.at.line

    @property
    def kept_for(self) -> str:
        """The distribution that the file is kept for, beside one for the others; empty for none."""
        return self.requirement.kept_for
