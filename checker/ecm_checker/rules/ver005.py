"""A contract lacks required fields."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.fields import missing_fields
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="VER005",
    name="contract_incomplete",
    dimension="versioning",
    severity="warning",
    who="config",
    part_of=("Complete",),
    consequence="whether it fits the robot cannot be decided before it runs",
    resolution="declare the fields in an overlay (ecm.yaml), or deploy it to a sandbox only",
)


def check(case: Case) -> Iterator[Finding]:
    """Required fields that nothing declares, infers or defaults."""
    for module in case.modules:
        missing = missing_fields(module.contract)
        if missing:
            text = f"{module.id} does not declare {', '.join(missing)}"
            yield RULE.finding(text, Entity("contract", module.id), (module,), certainty="unknown")
