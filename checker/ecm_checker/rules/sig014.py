"""A package needs what another one, which is here, does not provide, or provides otherwise."""

from __future__ import annotations

from collections.abc import Iterator

from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.rule import Rule
from ecm_checker.unmet_findings import unmet_findings

RULE = Rule(
    id="SIG014",
    name="requirement_unmet",
    dimension="signature",
    severity="error",
    who="source",
    part_of=("SigMatch",),
    consequence="the name is looked for in vain: a build, launch or load fails, or a value is silently ignored",
    resolution="write the name that is provided, or provide this one",
)


def check(case: Case) -> Iterator[Finding]:
    """Each requirement of the packages in question that a package of the question must meet and does not."""
    if case.packages is not None:
        yield from unmet_findings(RULE, case.packages.unmet())
