"""A part of what should be looked at could not be read."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.finding import Entity, Finding

from ecm_extract.observe.rule import ObserveRule
from ecm_extract.observe.watch import Watch

RULE = ObserveRule(
    id="OBS020",
    name="not_observed",
    dimension="recovery",
    severity="warning",
    who="graph",
    consequence="nothing that concerns it was decided",
    resolution="make it answer, or look at it another way, before relying on this run",
)


def check(watch: Watch) -> Iterator[Finding]:
    """Everything that the source names as not read."""
    for gap in watch.seen.gaps:
        text = f"{gap.what} could not be read: {gap.why}"
        yield RULE.seen(text, Entity("gap", gap.what), (gap.what,), certainty="unknown")
