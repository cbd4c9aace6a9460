"""A new version offers more than the one before."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.delta import gained
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="SIG011",
    name="output_added",
    dimension="signature",
    severity="info",
    who="graph",
    part_of=("DepPreserve",),
    consequence="modules that do not know it ignore it",
    resolution="nothing is needed; modules that could use it may now do so",
)


def check(case: Case) -> Iterator[Finding]:
    """Outputs and endpoints that only the new version has."""
    if case.previous is None:
        return
    for new in case.modules:
        for kind, name in gained(case.previous, new):
            yield RULE.finding(f"{new.id} now also offers {kind} {name}", Entity(kind, "", name), (new,))
