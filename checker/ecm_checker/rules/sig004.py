"""A client calls a name that nothing serves, while something of almost that name is served."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.near_miss import near_misses
from ecm_checker.rule import Rule

RULE = Rule(
    id="SIG004",
    name="client_without_server",
    dimension="signature",
    severity="warning",
    who="graph",
    part_of=("SigMatch",),
    by_absence=True,
    consequence="the client waits for a server that never becomes available",
    resolution="use one name on both sides, or remap it in the launch file",
)


def check(case: Case) -> Iterator[Finding]:
    """Clients of services and actions without a server."""
    return near_misses(case, RULE)
