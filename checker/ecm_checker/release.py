"""Compatibility classes and the version step that changes require (embodied semantic versioning).

Source: paper, "Embodied Semantic Versioning" and table "Release Compatibility Classes". Used by `check upgrade` and
by `diff`: both give changes of the same form.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, Final, Literal

import msgspec

from ecm_checker.contract import Evidence
from ecm_checker.finding import Dimension, digest
from ecm_checker.hub.kinds import Kind, row_of
from ecm_checker.versions import BUMPS, Bump

CompatibilityClass = Literal[
    "fully-compatible", "resource-sensitive", "recovery-sensitive", "policy-sensitive", "breaking"
]
ChangeWord = Literal[
    "added",
    "removed",
    "renamed",
    "moved",
    "type_changed",
    "default_changed",
    "signature_changed",
    "deprecated",
]
Action = Literal["promote", "revalidate", "governance_review", "migration"]

CLASSES: Final[tuple[CompatibilityClass, ...]] = (
    "fully-compatible",
    "resource-sensitive",
    "recovery-sensitive",
    "policy-sensitive",
    "breaking",
)
ACTIONS: Final[Mapping[CompatibilityClass, Action]] = {
    "fully-compatible": "promote",
    "resource-sensitive": "revalidate",
    "recovery-sensitive": "revalidate",
    "policy-sensitive": "governance_review",
    "breaking": "migration",
}
_FAMILY: Final = "change"
_SENSITIVE: Final[Mapping[str, CompatibilityClass]] = {
    "resources": "resource-sensitive",
    "recovery": "recovery-sensitive",
    "permissions": "policy-sensitive",
}


class Change(msgspec.Struct, frozen=True, kw_only=True):
    """One change of a public entity, in the wire format of `diff`.

    Attributes:
        kind: of the entity: topic, parameter, message_field, ..., or `field` for a field of a contract.
        change: what happened to it.
        package: that releases it.
        owner: module or type that has it.
        old: its name before; None when it was added.
        new: its name after; None when it was removed.
        breaking: whether somebody who uses the old version must change.
        dimension: of the contract.
        confidence: 0 to 1.
        reason: why it is breaking or not.
        evidence_old: line before.
        evidence_new: line after.
        old_value: type, default or form before, where that is what changed.
        new_value: the same after.
        cause: the change that explains this one, as `node arm of robot_driver`; None for a cause of its own.
    """

    kind: str
    change: ChangeWord
    package: str
    owner: str
    old: str | None
    new: str | None
    breaking: bool
    dimension: Dimension
    confidence: float = 1.0
    reason: str = ""
    evidence_old: Evidence | None = None
    evidence_new: Evidence | None = None
    old_value: str | None = None
    new_value: str | None = None
    cause: str | None = None

    @property
    def row(self) -> Kind:
        """What its kind is to others."""
        return row_of(self.kind)


def fingerprint_of(change: Change) -> str:
    """16 hexadecimal digits that everything said about a change shares: the change itself, and each use it breaks.

    Values are in it, so that who accepts one new type has not accepted the next one.
    """
    names = (change.old, change.new, change.old_value, change.new_value)
    words = (change.kind, change.change, change.package, change.owner)
    return digest(_FAMILY, *words, *(name or "" for name in names))


def class_of(change: Change) -> CompatibilityClass:
    """The class of one change: resources, recovery and permissions are sensitive when they are breaking."""
    if not change.breaking:
        return "fully-compatible"
    return _SENSITIVE.get(change.dimension, "breaking")


def compatibility_class(changes: Iterable[Change]) -> CompatibilityClass:
    """The severest class of changes."""
    return max(map(class_of, changes), key=CLASSES.index, default="fully-compatible")


def required_bump(changes: Iterable[Change]) -> Bump:
    """The least step: major for what may invalidate a composition, minor for additions, patch for the rest."""
    return max(map(_bump, changes), key=BUMPS.index, default="none")


def severity_of(name: CompatibilityClass) -> int:
    """Rank of a class, 0 for the mildest."""
    return CLASSES.index(name)


def declared_class(text: Any) -> CompatibilityClass | None:
    """The class that a contract declares, in either spelling; None when it is none of them."""
    spelled = str(text or "").replace("_", "-").lower()
    return next((name for name in CLASSES if name == spelled), None)


def _bump(change: Change) -> Bump:
    if change.breaking:
        return "major"
    return "patch" if change.change == "default_changed" else "minor"
