"""Names that are computed while the robot runs cannot be matched."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.contract import Interface
from ecm_checker.finding import Entity, Finding
from ecm_checker.hub.roles import roles
from ecm_checker.rule import Rule
from ecm_checker.view import View

RULE = Rule(
    id="SIG013",
    name="names_computed",
    dimension="signature",
    severity="info",
    who="graph",
    part_of=("SigMatch",),
    consequence="whether they connect shows only when they run",
    resolution="declare the names in an overlay (ecm.yaml) where it matters",
)

_SHOWN = 5


def check(case: Case) -> Iterator[Finding]:
    """One finding that lists all endpoints that no rule about names could look at."""
    found = [(module, entry) for module in case.modules for entry in _unmatched(module)]
    if found:
        names = sorted({f"{module.id} {entry.name}" for module, entry in found})
        rest = f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else ""
        text = f"{len(names)} endpoint(s) have names that are computed: {', '.join(names[:_SHOWN])}{rest}"
        modules = dict.fromkeys(module.id for module, _ in found)
        owners = [module for module in case.modules if module.id in modules]
        evidence = [entry.evidence[0] for _, entry in found if entry.evidence]
        yield RULE.finding(text, Entity("endpoint", "computed"), owners, evidence, certainty="unknown")


def _unmatched(module: View) -> Iterator[Interface]:
    for entry in module.unmatched:
        if roles()[entry.role].peer:
            yield entry
