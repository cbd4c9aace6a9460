"""Evidence: something observed, tested or reviewed of a release (`ecm-extract/evidence/1`)."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final, Literal

import msgspec
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry import audit, clock
from ecm_extract.registry.releases import find_release, name_of
from ecm_extract.registry.tables import EvidenceRow

Kind = Literal["observation", "validation", "upgrade_test", "policy_review", "rollback_test"]
Result = Literal["confirmed", "contradicted", "doubtful", "not_seen"]
SCHEMA: Final = "ecm-extract/evidence/1"
_MAX_BYTES: Final = 50_000_000


class Witness(msgspec.Struct, frozen=True):
    """Who says so: a person or a robot, and the tool with its version where one was used."""

    name: str
    tool: str = ""
    version: str = ""


class Subject(msgspec.Struct, frozen=True):
    """What it is about: a release, or one of its modules; `contract` is `sha256:` over what was in front of them."""

    package: str
    version: str
    module_id: str | None = None
    contract: str | None = None


class Evidence(msgspec.Struct, frozen=True, kw_only=True, omit_defaults=True):
    """Who saw what, when, on what, with which result.

    Attributes:
        kind: `observation` of a live system or a bag; `validation` of resources or recovery on a robot;
            `upgrade_test`; `policy_review`; `rollback_test`.
        begun: ISO 8601.
        on: what it was seen on, as data: a robot, a bag, a ticket.
        note: in words.
    """

    schema: Literal["ecm-extract/evidence/1"] = "ecm-extract/evidence/1"
    kind: Kind
    subject: Subject
    result: Result
    by: Witness
    begun: str
    on: Any = None
    note: str = ""

    @property
    def time(self) -> datetime:
        """When it began."""
        found = datetime.fromisoformat(self.begun)
        return found if found.tzinfo is not None else found.replace(tzinfo=UTC)


class Kept(msgspec.Struct, frozen=True):
    """Evidence as it is stored: the record, and the SHA-256 of its document."""

    digest: str
    evidence: Evidence


def read_evidence(file: str) -> list[bytes]:
    """Return the records of a file, one JSON document a line.

    Raises:
        InputError: the file cannot be read, or a line is no evidence; the message names the line.
    """
    place = Path(file)
    try:
        if place.stat().st_size > _MAX_BYTES:
            message = f"{file} is larger than {_MAX_BYTES} bytes"
            raise InputError(message)
        lines = place.read_bytes().splitlines()
    except OSError as error:
        message = f"cannot read {file}: {error.strerror}"
        raise InputError(message) from error
    for number, line in enumerate(lines, 1):
        if line.strip():
            _checked(line, f"{file}:{number}")
    return [line for line in lines if line.strip()]


def _checked(data: bytes, where: str) -> Evidence:
    try:
        found = msgspec.json.decode(data, type=Evidence)
        _ = found.time
    except (msgspec.MsgspecError, ValueError) as error:
        message = f"{where}: {error}"
        raise InputError(message, "evidence is what `ecm-extract observe` writes: ecm-extract/evidence/1") from error
    return found


def add_evidence(session: Session, records: Iterable[bytes]) -> list[str]:
    """Keep records, each with the release that it is about, and return these; what is there already stays once.

    Raises:
        InputError: a release is not stored.
    """
    about = []
    for data in records:
        found = _checked(data, "evidence")
        release = find_release(session, f"{found.subject.package}@{found.subject.version}")
        canonical = msgspec.json.encode(msgspec.json.decode(data), order="deterministic")
        digest = hashlib.sha256(canonical).hexdigest()
        if session.get(EvidenceRow, (digest, release.id)) is None:
            session.add(EvidenceRow(digest=digest, release_id=release.id, document=canonical.decode()))
            audit.append(session, "evidence", name_of(release), {"digest": digest, "kind": found.kind})
        about.append(name_of(release))
    return about


def evidence_of(session: Session, release_id: int) -> Sequence[Kept]:
    """Return what is known of a release, oldest first."""
    rows = session.scalars(select(EvidenceRow).filter_by(release_id=release_id))
    found = [Kept(row.digest, msgspec.json.decode(row.document, type=Evidence)) for row in rows]
    return sorted(found, key=lambda each: (each.evidence.time, each.digest))


def stated(session: Session, spec: str, *, kind: Kind, by: str, on: str | None, result: Result, note: str) -> bytes:
    """Return a record that a person states of the content that is stored of a release.

    Args:
        session: one that reads.
        spec: the release.
        kind: what was done.
        by: who did it.
        on: on what.
        result: what came of it.
        note: in words.

    Raises:
        InputError: the release is not stored.
    """
    release = find_release(session, spec)
    subject = Subject(release.package, release.version, None, f"sha256:{release.digest}")
    begun = clock.written(clock.now())
    record = Evidence(kind=kind, subject=subject, result=result, by=Witness(by), begun=begun, on=on, note=note)
    return msgspec.json.encode({"schema": SCHEMA, **msgspec.to_builtins(record)})
