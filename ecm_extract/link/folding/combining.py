"""Values that are computed of others, each of which may be one of several."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product
from typing import Any

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.link.running.values import (
    MAX_ALTERNATIVES,
    TOO_MANY,
    Hole,
    Value,
    alternatives,
    computed,
    data_in,
    unknown,
    weaker,
)


def combined(options: Sequence[tuple[Value, ...]], work: Callable[[list[Any]], Any], label: str) -> tuple[Value, ...]:
    """Compute with each combination of known values; what is not known or not computed stays a pattern.

    Args:
        options: for each part what it may be.
        work: gives data for the data of the parts, `UNKNOWN` where it can not.
        label: what a result is called that is not known.
    """
    found: list[Value] = []
    for values in product(*options):
        if len(found) > MAX_ALTERNATIVES:
            return alternatives((*found, TOO_MANY))
        data = [data_in(value) for value in values]
        result = None if UNKNOWN in data else computed(work(data))
        found.append(_left_open(values, label) if result is None else _as_sure(result, values))
    return alternatives(found) if len(found) > 1 else tuple(found) or (unknown(label),)


def _left_open(values: Sequence[Value], label: str) -> Value:
    """What is not computed: it still depends on the parameters that its parts depend on."""
    holes = [part for value in values for part in value.parts if isinstance(part, Hole)]
    open_ = tuple([hole._replace(default=None) for hole in holes if hole.kind in {"param", "made"}])
    named = next((hole.label for hole in holes), label) if label == "value" else label
    return Value(open_, "pattern") if open_ else unknown(named)


def _as_sure(result: Value, values: Sequence[Value]) -> Value:
    weakest = result.confidence
    for value in values:
        weakest = weaker(weakest, value.confidence)
    return result._replace(confidence=weakest)
