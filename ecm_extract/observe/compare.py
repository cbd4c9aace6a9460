"""What was seen against what contracts promise."""

from __future__ import annotations

from ecm_checker.finding import Finding
from ecm_checker.outcome import ordered

from ecm_extract.observe.catalogue import catalogue
from ecm_extract.observe.watch import Watch


def compare(watch: Watch) -> tuple[Finding, ...]:
    """Return what every rule says, most severe first; the order does not depend on that of the observation."""
    return ordered(finding for entry in catalogue() for finding in entry.check(watch))
