"""A finding: what a rule says of contracts, in the wire format that every command shares."""

from __future__ import annotations

import hashlib
from typing import Final, Literal

import msgspec

from ecm_checker.contract import Evidence

Dimension = Literal["signature", "behavior", "resources", "permissions", "recovery", "versioning"]
Severity = Literal["error", "warning", "info"]
Certainty = Literal["proved", "likely", "unknown"]
Who = Literal["wire", "graph", "qos", "config", "source", "safety"]

DIMENSIONS: Final[tuple[Dimension, ...]] = (
    "signature",
    "behavior",
    "resources",
    "permissions",
    "recovery",
    "versioning",
)
SEVERITIES: Final[tuple[Severity, ...]] = ("error", "warning", "info")


class Entity(msgspec.Struct, frozen=True):
    """What a finding is about; it makes the fingerprint.

    Attributes:
        kind: `topic`, `claim`, `sensor`, ...
        old: its name, the name that is looked for, or the name on the offering side.
        new: the name on the other side, or a near one that is there; empty when there is one name only.
        owner: whose it is where names repeat within a package: the robot of a joint, the node of a parameter.
    """

    kind: str
    old: str
    new: str = ""
    owner: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        """All names in it."""
        return self.old, self.new, self.owner


class Rename(msgspec.Struct, frozen=True, tag_field="kind", tag="rename"):
    """An edit: the first line of the evidence has `old` as a word of its own; write `new` for it."""

    old: str
    new: str


class Depend(msgspec.Struct, frozen=True, tag_field="kind", tag="depend"):
    """An edit: the package.xml of the subject names one more package, which its build needs, or only its run."""

    package: str
    need: Literal["build", "run"]


Edit = Rename | Depend


class Finding(msgspec.Struct, frozen=True, kw_only=True):
    """One conflict, doubt or hint.

    Attributes:
        rule: id such as `RES001`.
        name: of the rule, for people.
        dimension: of the contract that it concerns.
        severity: an `error` is always proved; what is only likely is at most a `warning`.
        message: what is so, and what the robot does when it is ignored.
        resolution: what to do about it.
        subjects: module ids, the one that comes first in the composition or the alphabet first.
        evidence: lines of all sides.
        fingerprint: same for the same cause, wherever it moves and however it is worded.
        who: what breaks.
        certainty: `unknown` when a field that the decision needs is undeclared.
        about: what it is about, as data: the message says the same in words.
        edit: what surely mends it; None where a person has to choose.
    """

    rule: str
    name: str
    dimension: Dimension
    severity: Severity
    message: str
    resolution: str
    subjects: tuple[str, ...]
    evidence: tuple[Evidence, ...]
    fingerprint: str
    who: Who
    certainty: Certainty
    about: Entity | None = None
    edit: Edit | None = None

    def names(self, word: str) -> bool:
        """Whether one of the names that it is about has a word in it; nobody reads its message for that."""
        return self.about is None or any(word in name for name in (*self.about.names, *self.subjects))


def fingerprint(rule: str, entity: Entity, packages: tuple[str, ...]) -> str:
    """16 hexadecimal digits over rule, kind of entity, packages, old and new name, and the owner where one is named.

    Neither path, line nor wording is in it, so that a moved line keeps its exceptions.
    """
    owner = ("", entity.owner) if entity.owner else ()
    return digest(rule, entity.kind, *packages, "", entity.old, entity.new, *owner)


def digest(*parts: str) -> str:
    """16 hexadecimal digits over texts."""
    return hashlib.sha256("\0".join(parts).encode("utf-8", "replace")).hexdigest()[:16]
