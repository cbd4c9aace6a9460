"""A new release no longer has a module."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Entity, Finding
from ecm_checker.rule import Rule

RULE = Rule(
    id="VER007",
    name="module_removed",
    dimension="versioning",
    severity="warning",
    who="config",
    part_of=("DepPreserve",),
    consequence="launch files and compositions that name it fail to start",
    resolution="keep it for one release cycle and deprecate it, or name what replaces it in the migration notes",
)


def check(case: Case) -> Iterator[Finding]:
    """An upgrade that has an old version and no new one."""
    old = case.previous
    if old is not None and not case.modules:
        text = f"{old.id} is not in the new release, or has another name there"
        yield RULE.finding(text, Entity("module", old.id), (old,), certainty="unknown")
