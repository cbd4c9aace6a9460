"""A deprecated module is installed or upgraded to."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="VER004",
    name="module_deprecated",
    dimension="versioning",
    severity="warning",
    who="config",
    part_of=("Complete", "DepPreserve"),
    consequence="it will be removed, and then nothing takes its place",
    resolution="move to what replaces it within this release cycle",
)


def check(case: Case) -> Iterator[Finding]:
    """Modules whose release says that they are going away."""
    for module in case.modules:
        value = module.contract.versioning.deprecated
        if value is not None and value.value not in (False, "", None):
            text = f"{module.id} is deprecated{f' ({value.value})' if isinstance(value.value, str) else ''}"
            yield RULE.finding(text, Entity("module", module.id), (module,), value.evidence)
