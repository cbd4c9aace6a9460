"""The documents that other programs read: the manifest of a module, the extract of a tree, a record of evidence.

Keys are never changed without a new schema number. They differ from the contract model in one place only:
`missing` stands inside section `ecm`, so that a reader sees at the top what is not known.
"""

from __future__ import annotations

from typing import Final, Literal, TypeAlias

import msgspec
from msgspec import UNSET, UnsetType

from ecm_checker.contract import (
    Behavior,
    Permissions,
    Recovery,
    Resources,
    Signature,
    Source,
    Versioning,
)

MANIFEST_SCHEMA: Final = "ecm-extract/manifest/1"
EXTRACT_SCHEMA: Final = "ecm-extract/extract/1"
EVIDENCE_SCHEMA: Final = "ecm-extract/evidence/1"
GAP_REASONS: Final = frozenset(
    {
        *("missing", "too-large", "unreadable", "malformed", "unjudged"),
        *("stopped", "unfollowed", "outside", "undecided", "generated"),
    }
)
"""Why something was not read although nobody asked to leave it out."""


class Ecm(msgspec.Struct, frozen=True, kw_only=True):
    """Section `ecm`: which module this is, and which required fields of its contract nothing fills."""

    module_id: str
    package: str
    kind: str
    version: str | None
    release_channel: str | None = None
    compatibility_class: str | None = None
    source: Source
    ros: Literal[1, 2] | None
    missing: tuple[str, ...] = ()


class Module(msgspec.Struct, frozen=True, kw_only=True):
    """The contract of one module as it is written; an undeclared field is absent, never an empty list."""

    ecm: Ecm
    signature: Signature = Signature()
    behavior: Behavior = Behavior()
    resources: Resources = Resources()
    permissions: Permissions = Permissions()
    recovery: Recovery = Recovery()
    versioning: Versioning = Versioning()


class Manifest(Module, frozen=True, kw_only=True):
    """A module in a file of its own, with the number of its schema."""

    schema: Literal["ecm-extract/manifest/1"]


class Diagnostic(msgspec.Struct, frozen=True):
    """Something that could not be read: path relative to the tree, 1-based line, 0 for the whole file."""

    severity: Literal["error", "warning", "info"]
    code: str
    path: str
    line: int
    message: str


class NotRead(msgspec.Struct, frozen=True):
    """Something that was not read: path, reason, whether it can declare interfaces, the commit of a submodule."""

    path: str
    reason: str
    carries: bool
    commit: str = ""

    @property
    def is_gap(self) -> bool:
        """Whether what is known says less than the whole because of it: nobody asked to leave it out."""
        return self.carries and self.reason in GAP_REASONS


class Origin(msgspec.Struct, frozen=True):
    """The tree that was read: as the user named it, and its commit when it has one."""

    path: str
    commit: str | None


class Witness(msgspec.Struct, frozen=True):
    """Who says so: a person or a robot by name, and the tool with its version where one was used."""

    name: str
    tool: str = ""
    version: str = ""


class LookedAt(msgspec.Struct, frozen=True):
    """What was looked at.

    Attributes:
        source: `ros1`, `dds` or `bag`. target: URI, domain or files, as given.
        senses: what this source can see; about anything else the record says nothing.
        digest: `sha256:` over it.
    """

    source: str
    target: str
    senses: tuple[str, ...]
    digest: str


class EvidenceSubject(msgspec.Struct, frozen=True):
    """What it is about: a release of a package, or one of its modules.

    Attributes:
        version: of the package; None where it declares none, and then no registry knows the release.
        module_id: of the module; None for the package as a whole.
        contract: `sha256:` over what was in front of the witness, as canonical JSON: the contract of the module without
            the repository and commit that it was read from, or the document of the package. None where nobody knows.
    """

    package: str
    version: str | None
    module_id: str | None = None
    contract: str | None = None


class EvidenceFinding(msgspec.Struct, frozen=True):
    """What spoke against the contract."""

    rule: str
    severity: Literal["error", "warning", "info"]
    certainty: Literal["proved", "likely", "unknown"]
    fingerprint: str
    message: str


EvidenceKind: TypeAlias = Literal["observation", "validation", "upgrade_test", "policy_review", "rollback_test"]
EvidenceResult: TypeAlias = Literal["confirmed", "contradicted", "doubtful", "not_seen"]


class EvidenceRecord(msgspec.Struct, frozen=True, kw_only=True):
    """What was observed, tested or reviewed of a release: who, when, on what, with which result.

    Attributes:
        kind: `observation` of a live system or a recording; `validation` of resources or recovery on a robot;
            `upgrade_test`; `policy_review`; `rollback_test`.
        result: `confirmed`: it ran as its contract says, as far as the source can see, or the test or review was
            passed; `contradicted`: something that it did is proved against its contract, or it was not passed;
            `doubtful`: a warning, or a part that could not be read; `not_seen`: it did not run.
        begun: ISO 8601 in UTC. seconds: how long it was looked at.
        on: what was looked at; in words where a person states it.
        nodes: that it ran as.
        promised, seen: endpoints of the contract that the source can see at all, and those that it saw.
        findings: what spoke against the contract. note: in words.
    """

    schema: Literal["ecm-extract/evidence/1"]
    kind: EvidenceKind
    subject: EvidenceSubject
    result: EvidenceResult
    by: Witness
    begun: str
    on: LookedAt | str | None = None
    seconds: float | UnsetType = UNSET
    nodes: tuple[str, ...] | UnsetType = UNSET
    promised: int | UnsetType = UNSET
    seen: int | UnsetType = UNSET
    findings: tuple[EvidenceFinding, ...] | UnsetType = UNSET
    note: str | UnsetType = UNSET

    @property
    def is_observed(self) -> bool:
        """Whether a contract was compared with what ran."""
        return self.kind == "observation" or self.promised is not UNSET
