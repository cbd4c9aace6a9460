"""Statistics over cases. Source: paper table "Recall with Wilson 95 % confidence intervals and exact McNemar tests"."""

from __future__ import annotations

from collections.abc import Sequence

import msgspec


class Share(msgspec.Struct, frozen=True):
    """How many of how many, with the Wilson 95 % interval of the share (0 to 1)."""

    hits: int
    total: int
    low: float
    high: float


class Paired(msgspec.Struct, frozen=True):
    """Exact McNemar test of two methods: cases that only one of them has, and the two-sided p value."""

    first_only: int
    second_only: int
    p: float


def share(hits: int, total: int) -> Share:
    """The share with its interval; that of nothing is 0 to 1."""
    from scipy.stats import binomtest

    if total == 0:
        return Share(0, 0, 0.0, 1.0)
    interval = binomtest(hits, total).proportion_ci(0.95, method="wilson")
    return Share(hits, total, float(interval.low), float(interval.high))


def mcnemar(first: Sequence[bool], second: Sequence[bool]) -> Paired:
    """Compare two methods over the same cases in the same order.

    Raises:
        ValueError: the lengths differ.
    """
    from scipy.stats import binomtest

    pairs = list(zip(first, second, strict=True))
    one, two = sum(a and not b for a, b in pairs), sum(b and not a for a, b in pairs)
    p = float(binomtest(one, one + two, 0.5).pvalue) if one + two else 1.0
    return Paired(one, two, p)
