"""The version of a release says less than its contract changed."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.contract_changes import changes
from ecm_checker.finding import Entity, Finding
from ecm_checker.release import required_bump
from ecm_checker.rule import Rule
from ecm_checker.versions import BUMPS, bump_between

RULE = Rule(
    id="VER003",
    name="bump_too_small",
    dimension="versioning",
    severity="warning",
    who="config",
    part_of=("DepPreserve",),
    consequence="deployments take the release for a harmless one and upgrade without the checks that it needs",
    resolution="raise the version as embodied semantic versioning requires",
)


def check(case: Case) -> Iterator[Finding]:
    """The step between the two versions against the one that the changes of the contract require."""
    old = case.previous
    if old is None:
        return
    for new in case.modules:
        before, after = old.contract.ecm.version, new.contract.ecm.version
        declared, required = bump_between(before, after), required_bump(changes(old, new))
        if declared is None:
            text = f"{new.id}: the step from version {before} to {after} cannot be read"
            yield RULE.finding(text, Entity("version", new.id), (new,), certainty="unknown")
        elif BUMPS.index(declared) < BUMPS.index(required):
            text = f"{new.id}: {before} to {after} is a {declared} step, the changes need a {required} one"
            yield RULE.finding(text, Entity("version", new.id), (new,))
