"""What a rule says of packages, where names alone decide, so that it is likely and never proved."""

from __future__ import annotations

from collections.abc import Iterable

from ecm_checker.any_rule import Said
from ecm_checker.contract import Evidence
from ecm_checker.finding import Entity, Severity


def package_said(
    text: str,
    entity: Entity,
    packages: Iterable[str],
    evidence: Iterable[Evidence],
    severity: Severity | None = None,
) -> Said:
    """Return what a finding about packages says.

    Args:
        text: what is so, naming both sides.
        entity: what it is about.
        packages: whose it is, the one that provides first.
        evidence: lines of all sides, the causing one first.
        severity: where it differs from that of the rule.
    """
    owners = tuple(dict.fromkeys(packages))
    return Said(
        text=text,
        entity=entity,
        owners=owners,
        subjects=tuple(f"ecm.{name}" for name in owners),
        evidence=tuple(dict.fromkeys(evidence)),
        certainty="likely",
        severity=severity,
    )
