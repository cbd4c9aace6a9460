"""A rule of check: which sub-checks of the operations it is part of, and how it makes a finding about modules."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Literal

import msgspec

from ecm_checker.any_rule import AnyRule, Said
from ecm_checker.case import Case
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Entity, Finding, Severity
from ecm_checker.view import View

SubCheck = Literal[
    "DepSat",
    "ResSat",
    "PermSat",
    "Complete",
    "LockSafe",
    "InputSat",
    "PreSat",
    "AllocSat",
    "FailureSat",
    "SigMatch",
    "BehMatch",
    "ResJointSat",
    "PermChainSafe",
    "RecMatch",
    "GlobalSafe",
    "DepPreserve",
    "PermDeltaSafe",
    "ResDeltaSafe",
    "RecDeltaSafe",
]
Tier = Literal["schema", "qos", "semver"]


class Rule(AnyRule, frozen=True, kw_only=True):
    """What a rule file of check declares beside what every rule does.

    Attributes:
        part_of: sub-checks of the paper's operators that it belongs to.
        tier: simplest baseline that has this rule too; None for our own.
        by_absence: whether it says that something is not there, which may stand in what could not be read.
    """

    part_of: tuple[SubCheck, ...]
    tier: Tier | None = None
    by_absence: bool = False

    def finding(
        self,
        text: str,
        entity: Entity,
        subjects: Iterable[View],
        evidence: Iterable[Evidence] = (),
        *,
        certainty: Certainty = "proved",
        severity: Severity | None = None,
    ) -> Finding:
        """A finding of this rule.

        Args:
            text: what is so, naming both sides.
            entity: what it is about.
            subjects: modules concerned.
            evidence: lines of all sides.
            certainty: what is not proved is at most a warning.
            severity: where it differs from that of the rule.
        """
        modules = tuple(subjects)
        said = Said(
            text=text,
            entity=entity,
            owners=tuple(dict.fromkeys(module.package for module in modules)),
            subjects=tuple(dict.fromkeys(module.id for module in modules)),
            evidence=evidence,
            certainty=certainty,
            severity=severity,
        )
        return self.found(said)


Check = Callable[[Case], Iterator[Finding]]


class Entry(msgspec.Struct, frozen=True):
    """A rule of the catalogue with the function that checks it."""

    rule: Rule
    check: Check
