"""The declared compatibility class is milder than what changed."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.contract_changes import changes
from ecm_checker.finding import Entity, Finding
from ecm_checker.release import compatibility_class, declared_class, severity_of
from ecm_checker.rule import Rule

RULE = Rule(
    id="VER006",
    name="compatibility_class_too_mild",
    dimension="versioning",
    severity="warning",
    who="config",
    part_of=("DepPreserve",),
    consequence="the release is promoted without the review that its changes need",
    resolution="declare the class that the changes have",
)


def check(case: Case) -> Iterator[Finding]:
    """The class that the new version declares against the one that its changes have."""
    old = case.previous
    if old is None:
        return
    for new in case.modules:
        declared = declared_class(new.contract.ecm.compatibility_class)
        found = compatibility_class(changes(old, new))
        if declared is not None and severity_of(declared) < severity_of(found):
            text = f"{new.id} declares itself {declared}, its changes are {found}"
            yield RULE.finding(text, Entity("class", new.id), (new,))
