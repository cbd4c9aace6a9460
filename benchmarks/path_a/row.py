"""A row of Path A: what contracts predict, what was observed in each repetition, and whether the two agree."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

FIXTURES = Path(__file__).parents[2] / "fixtures" / "path_a"


class NotMeasured(Exception):  # noqa: N818  it is no error: the row says why
    """This machine lacks what the row needs; the text says what and how to get it."""


@dataclass(frozen=True)
class Observed:
    """One repetition: what happened, in words, and whether it is what was predicted."""

    text: str
    as_predicted: bool


@dataclass(frozen=True)
class Case:
    """One prediction with its repetitions.

    Attributes:
        name: of the case. prediction: what contracts say, with the rule. observed: each repetition.
        missing: why it was not measured; empty when it was.
        history: what was judged by another criterion before, how it came out, and since when this one stands.
    """

    name: str
    prediction: str
    observed: tuple[Observed, ...] = ()
    missing: str = ""
    history: tuple[str, ...] = ()

    @property
    def verdict(self) -> str:
        """`confirmed` only when every repetition is as predicted."""
        if self.missing:
            return "not measured"
        return "confirmed" if all(each.as_predicted for each in self.observed) else "REFUTED"


Row = Callable[[int], Sequence[Case]]
"""Measures one row with so many repetitions."""


def shown(case: Case) -> str:
    lines = [f"{case.name}: {case.verdict}", f"  predicted: {case.prediction}"]
    if case.missing:
        return "\n".join([*lines, f"  not measured: {case.missing}"])
    return "\n".join([*lines, *_observed(case), *(f"  history: {each}" for each in case.history)])


def _observed(case: Case) -> list[str]:
    texts = list(dict.fromkeys(each.text for each in case.observed))
    if len(texts) == 1:
        return [f"  observed, {len(case.observed)} times: {texts[0]}"]
    return [f"  observed {number}: {each.text}" for number, each in enumerate(case.observed, 1)]
