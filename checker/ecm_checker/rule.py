"""A rule: what it is called, which sub-checks of the operations it is part of, and how it makes a finding."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Final, Literal

import msgspec

from ecm_checker.case import Case
from ecm_checker.contract import Evidence
from ecm_checker.finding import Certainty, Dimension, Entity, Finding, Severity, Who, fingerprint
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

_WORST_WITHOUT_PROOF: Final[Severity] = "warning"


class PackageMatter(msgspec.Struct, frozen=True):
    """What a finding about packages says.

    Attributes:
        text: what is so. consequence: what happens when it is ignored.
        entity: what it is about. who: what breaks.
        packages: the one that provides first. evidence: lines of all sides.
        severity: where it differs from that of the rule.
    """

    text: str
    consequence: str
    entity: Entity
    who: Who
    packages: tuple[str, ...]
    evidence: tuple[Evidence, ...]
    severity: Severity | None = None


class Rule(msgspec.Struct, frozen=True, kw_only=True):
    """What a rule file declares.

    Attributes:
        id: `SIG001`; the name of its file in lower case.
        name: for people, snake case.
        dimension: of the contract.
        severity: of a finding that is proved.
        who: what breaks.
        part_of: sub-checks of the paper's operators that it belongs to.
        consequence: what the robot does when it is ignored.
        resolution: what to do.
        tier: simplest baseline that has this rule too; None for our own.
    """

    id: str
    name: str
    dimension: Dimension
    severity: Severity
    who: Who
    part_of: tuple[SubCheck, ...]
    consequence: str
    resolution: str
    tier: Tier | None = None

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
        packages = tuple(dict.fromkeys(module.package for module in modules))
        ids = tuple(dict.fromkeys(module.id for module in modules))
        return self._made(text, entity, packages, ids, evidence, certainty, severity or self.severity)

    def package_finding(self, told: PackageMatter, certainty: Certainty) -> Finding:
        """A finding of this rule about packages as a whole; what is not proved is at most a warning."""
        ids = tuple(f"ecm.{name}" for name in told.packages)
        level = told.severity or self.severity
        found = self._made(told.text, told.entity, told.packages, ids, told.evidence, certainty, level)
        return msgspec.structs.replace(found, message=f"{told.text}: {told.consequence}", who=told.who)

    def _made(
        self,
        text: str,
        entity: Entity,
        packages: tuple[str, ...],
        subjects: tuple[str, ...],
        evidence: Iterable[Evidence],
        certainty: Certainty,
        level: Severity,
    ) -> Finding:
        return Finding(
            rule=self.id,
            name=self.name,
            dimension=self.dimension,
            severity=_WORST_WITHOUT_PROOF if level == "error" and certainty != "proved" else level,
            message=f"{text}: {self.consequence}" if self.consequence else text,
            resolution=self.resolution,
            subjects=subjects,
            evidence=tuple(evidence),
            fingerprint=fingerprint(self.id, entity, packages),
            who=self.who,
            certainty=certainty,
        )


Check = Callable[[Case], Iterator[Finding]]


class Entry(msgspec.Struct, frozen=True):
    """A rule of the catalogue with the function that checks it."""

    rule: Rule
    check: Check
