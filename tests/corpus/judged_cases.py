"""What a blind run said of two cases."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import msgspec
from ecm_corpus.blind import Outcome
from ecm_corpus.interface import InterfaceCase
from ecm_corpus.results import StateResult


class Judged(msgspec.Struct, frozen=True):
    """Two cases with the folder of their clones, and what a blind run says of them."""

    clones: Path
    small: InterfaceCase
    other: InterfaceCase
    outcome: Outcome

    @property
    def states(self) -> Mapping[str, StateResult]:
        """The states of the renamed topic."""
        return next(case.states for case in self.outcome.results.cases if case.case == self.small.case)
