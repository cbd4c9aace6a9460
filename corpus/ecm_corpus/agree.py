"""Agreement between judges of the same briefs.

Source: paper sections "Are the Conflicts Interface-Derivable?" and "Labelling reliability".
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import combinations
from pathlib import Path
from typing import Literal

import msgspec
from ecm_checker.finding import Dimension

from ecm_corpus.interface import read_record
from ecm_extract.errors import InputError


class Verdict(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What a judge says of one brief; a dimension only where something is incompatible."""

    outcome: Literal["compatible", "incompatible", "cannot tell"]
    dimension: Dimension | None = None

    @property
    def label(self) -> str:
        """Outcome, or the dimension of what is incompatible."""
        return self.dimension if self.outcome == "incompatible" and self.dimension is not None else self.outcome


class Judge(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The verdicts of one judge by the id of the brief."""

    judge: str
    verdicts: dict[str, Verdict]


class Agreement(msgspec.Struct, frozen=True):
    """How far two judges agree over the briefs that both have judged.

    Attributes:
        judges: their names. briefs: how many both have judged.
        outcomes, labels: how many they agree on: on the outcome, and on the dimension too.
        kappa_outcomes, kappa_labels: Cohen's kappa of these; None when chance alone explains all of it.
    """

    judges: tuple[str, str]
    briefs: int
    outcomes: int
    labels: int
    kappa_outcomes: float | None
    kappa_labels: float | None


def agreement(first: Judge, second: Judge) -> Agreement:
    """Compare two judges."""
    both = sorted(first.verdicts.keys() & second.verdicts.keys())
    pairs = [(first.verdicts[brief], second.verdicts[brief]) for brief in both]
    outcomes = [(one.outcome, two.outcome) for one, two in pairs]
    labels = [(one.label, two.label) for one, two in pairs]
    return Agreement(
        judges=(first.judge, second.judge),
        briefs=len(pairs),
        outcomes=sum(one == two for one, two in outcomes),
        labels=sum(one == two for one, two in labels),
        kappa_outcomes=kappa(outcomes),
        kappa_labels=kappa(labels),
    )


def agreements(judges: Sequence[Judge]) -> list[Agreement]:
    """Compare every two of them."""
    return [agreement(one, two) for one, two in combinations(judges, 2)]


def kappa(pairs: Sequence[tuple[str, str]]) -> float | None:
    """Cohen's kappa: agreement beyond chance, as a share of what is possible beyond chance (Cohen 1960).

    Args:
        pairs: labels of the first and the second judge.
    """
    total = len(pairs)
    if total == 0:
        return None
    seen = sum(one == two for one, two in pairs) / total
    first, second = Counter(one for one, _ in pairs), Counter(two for _, two in pairs)
    chance = sum(first[label] * second[label] for label in first) / total**2
    return None if chance == 1 else (seen - chance) / (1 - chance)


def read_judges(paths: Sequence[Path]) -> list[Judge]:
    """Judges from their files, one each.

    Raises:
        InputError: a file cannot be read or does not fit, or there are fewer than two.
    """
    judges = [read_record(path, Judge) for path in paths]
    if len(judges) < 2:
        message = "agreement needs the answers of two judges"
        raise InputError(message, "name one file for each judge")
    return judges
