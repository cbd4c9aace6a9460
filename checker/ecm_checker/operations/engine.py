"""Runs the rules that an operation consults over a case, and decides."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache

import msgspec

from ecm_checker.case import Case
from ecm_checker.catalogue import catalogue
from ecm_checker.contract import Contract
from ecm_checker.finding import DIMENSIONS, Dimension, Finding
from ecm_checker.freeze import content_hash
from ecm_checker.operations.table import NEEDS, OPERATIONS, Name, Operation
from ecm_checker.outcome import Report, conditions, decide, ordered
from ecm_checker.profiles import Profiles
from ecm_checker.rule import Entry, SubCheck
from ecm_checker.view import View, view

Subject = Contract | View
ALL: tuple[Dimension, ...] = DIMENSIONS


def ready(subject: Subject) -> View:
    """The view of a contract; a view is passed through, so that it can be made once for many checks."""
    return subject if isinstance(subject, View) else view(subject)


def findings(case: Case, entries: Iterable[Entry]) -> list[Finding]:
    """What rules say of a case, in no order."""
    found = [each for entry in entries for each in entry.check(case)]
    return found if case.together else [_possible(each) for each in found]


def examine(operation: Name, case: Case, dimensions: Sequence[Dimension] = ALL) -> list[Finding]:
    """What the rules of an operation say of a case; dimensions that are left out are not consulted."""
    row = OPERATIONS[operation]
    return findings(case, consulted(row.sub_checks, _dimensions(row, dimensions)))


def report(
    operation: Name, found: Iterable[Finding], profiles: Profiles, dimensions: Sequence[Dimension] = ALL
) -> Report:
    """The report on findings of an operation."""
    row = OPERATIONS[operation]
    listed = ordered(found)
    outcome = decide(listed)
    return Report(
        operation=operation,
        outcome=outcome,
        conditions=conditions(listed) if outcome == "accept_with_conditions" else (),
        findings=listed,
        dimensions=_dimensions(row, dimensions),
        not_asked=_not_asked(
            row.sub_checks,
            profiles.embodiment is not None,
            profiles.policy is not None,
            profiles.runtime is not None,
        ),
        checker=content_hash(),
    )


@cache
def consulted(sub_checks: tuple[SubCheck, ...], dimensions: tuple[Dimension, ...]) -> tuple[Entry, ...]:
    """Rules that are part of any of the sub-checks and of a dimension that is consulted."""
    return tuple(
        entry
        for entry in catalogue()
        if entry.rule.dimension in dimensions and not set(sub_checks).isdisjoint(entry.rule.part_of)
    )


def _dimensions(row: Operation, wanted: Sequence[Dimension]) -> tuple[Dimension, ...]:
    return row.dimensions if wanted is ALL else tuple(each for each in row.dimensions if each in wanted)


@cache
def _not_asked(sub_checks: tuple[SubCheck, ...], embodiment: bool, policy: bool, runtime: bool) -> tuple[str, ...]:
    given = {"embodiment": embodiment, "policy": policy, "runtime": runtime}
    return tuple(f"{name}: no {NEEDS[name]} profile" for name in sub_checks if name in NEEDS and not given[NEEDS[name]])


def _possible(finding: Finding) -> Finding:
    """A conflict between modules that may never run together is a condition, not an error."""
    if finding.severity != "error" or len(finding.subjects) < 2:
        return finding
    message = f"if they run together: {finding.message}"
    return msgspec.structs.replace(finding, severity="warning", certainty="likely", message=message)
