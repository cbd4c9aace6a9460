"""Users of a package need what its new release no longer provides, or provides otherwise."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.match.packages import broken
from ecm_checker.rule import Rule
from ecm_checker.unmet_findings import unmet_findings

RULE = Rule(
    id="VER008",
    name="requirement_broken",
    dimension="versioning",
    severity="error",
    who="source",
    part_of=("DepPreserve",),
    consequence="the name is looked for in vain: a build, launch or load fails, or a value is silently ignored",
    resolution="keep the name for one release cycle and deprecate it, or change its users with it",
)


def check(case: Case) -> Iterator[Finding]:
    """Each requirement of the users that the old release met and the new one does not, from documents alone."""
    if case.packages is not None and case.replaced is not None and case.users is not None:
        yield from unmet_findings(RULE, broken(case.users, case.replaced, case.packages))
