"""A subscriber listens to a name that nothing publishes, while almost that name is published."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.near_miss import near_misses
from ecm_checker.rule import Rule

RULE = Rule(
    id="SIG005",
    name="topic_near_miss",
    dimension="signature",
    severity="warning",
    who="graph",
    part_of=("SigMatch",),
    by_absence=True,
    consequence="the two never connect; the subscriber waits for ever",
    resolution="use one name on both sides, or remap it in the launch file",
)


def check(case: Case) -> Iterator[Finding]:
    """Subscribers without a publisher."""
    return near_misses(case, RULE)
