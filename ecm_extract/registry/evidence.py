"""Evidence of releases as it is kept: something observed, tested or reviewed (`ecm-extract/evidence/1`)."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

import msgspec
from ecm_checker.wire import EvidenceKind, EvidenceRecord, EvidenceResult, EvidenceSubject, Witness
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.contract_digest import contract_digest
from ecm_extract.errors import InputError
from ecm_extract.registry import audit, clock
from ecm_extract.registry.releases import find_release, name_of, package_of_release
from ecm_extract.registry.tables import EvidenceRow, Release

_MAX_BYTES: Final = 50_000_000


class Kept(msgspec.Struct, frozen=True):
    """Evidence as it is stored: the record, and the SHA-256 of its document."""

    digest: str
    evidence: EvidenceRecord

    @property
    def time(self) -> datetime:
        """When it began."""
        return _time(self.evidence)


class Added(msgspec.Struct, frozen=True):
    """A record that was kept: the release that it is about, and whether it names the content that is stored of it."""

    release: str
    names_content: bool


def read_evidence(file: str) -> list[EvidenceRecord]:
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
    return [_decoded(line, f"{file}:{number}") for number, line in enumerate(lines, 1) if line.strip()]


def _decoded(data: bytes, where: str) -> EvidenceRecord:
    try:
        found = msgspec.json.decode(data, type=EvidenceRecord)
        _ = _time(found)
    except (msgspec.MsgspecError, ValueError) as error:
        message = f"{where}: {error}"
        raise InputError(message, "evidence is what `ecm-extract observe` writes: ecm-extract/evidence/1") from error
    return found


def add_evidence(session: Session, records: Iterable[EvidenceRecord]) -> list[Added]:
    """Keep records, each with the release that it is about; what is there already stays once.

    Args:
        session: one that writes.
        records: all of them are kept, or none.

    Raises:
        InputError: a release is not stored, a record names nobody, or it begins later than now.
    """
    return [_add(session, each) for each in records]


def _add(session: Session, record: EvidenceRecord) -> Added:
    _require_sound(record)
    release = find_release(session, f"{record.subject.package}@{record.subject.version}")
    canonical = msgspec.json.encode(record, order="deterministic")
    digest = hashlib.sha256(canonical).hexdigest()
    if session.get(EvidenceRow, (digest, release.id)) is None:
        session.add(EvidenceRow(digest=digest, release_id=release.id, document=canonical.decode()))
        audit.append(session, "evidence", name_of(release), {"digest": digest, "kind": record.kind})
    return Added(name_of(release), names_content(record, contents_of(session, release)))


def _require_sound(record: EvidenceRecord) -> None:
    subject = record.subject
    if not subject.version:
        message = f"the record is about {subject.package} without a version"
        raise InputError(message, "observe contracts that have a version, or those of the registry: --release")
    if not record.by.name.strip():
        message = f"the record about {subject.package}@{subject.version} does not say who saw it"
        raise InputError(message, "name a person or a robot")
    if clock.is_to_come(_time(record)):
        message = f"the record about {subject.package}@{subject.version} begins at {record.begun}, which is to come"
        raise InputError(message, "set the clock of the machine that recorded it, and look again")


def contents_of(session: Session, release: Release) -> dict[str | None, str]:
    """Return what is stored of a release as evidence names it: of each module by its id, of the package under None."""
    modules = package_of_release(session, release).contracts()
    return {None: f"sha256:{release.digest}", **{each.ecm.module_id: contract_digest(each) for each in modules}}


def names_content(record: EvidenceRecord, contents: Mapping[str | None, str]) -> bool:
    """Whether a record is about this very content, and not about another one under the same version."""
    return record.subject.contract is not None and record.subject.contract == contents.get(record.subject.module_id)


def evidence_of(session: Session, release_id: int) -> Sequence[Kept]:
    """Return what is known of a release, oldest first."""
    rows = session.scalars(select(EvidenceRow).filter_by(release_id=release_id))
    found = [Kept(row.digest, msgspec.json.decode(row.document, type=EvidenceRecord)) for row in rows]
    return sorted(found, key=in_time)


def in_time(kept: Kept) -> tuple[datetime, bool, str]:
    """Return the order of records; of two of one moment, as of one recording, the one that contradicts is the later."""
    return kept.time, kept.evidence.result == "contradicted", kept.digest


class Statement(msgspec.Struct, frozen=True):
    """What a person says was done: by whom, on what, what came of it, and in words."""

    kind: EvidenceKind
    by: str
    on: str | None = None
    result: EvidenceResult = "confirmed"
    note: str = ""


def stated(session: Session, spec: str, said: Statement) -> EvidenceRecord:
    """Return a record of what a person states of the content that is stored of a release.

    Raises:
        InputError: the release is not stored.
    """
    release = find_release(session, spec)
    return EvidenceRecord(
        schema="ecm-extract/evidence/1",
        kind=said.kind,
        subject=EvidenceSubject(release.package, release.version, None, f"sha256:{release.digest}"),
        result=said.result,
        by=Witness(said.by),
        begun=clock.written(clock.now()),
        on=said.on,
        note=said.note,
    )


def _time(record: EvidenceRecord) -> datetime:
    found = datetime.fromisoformat(record.begun)
    return found if found.tzinfo is not None else found.replace(tzinfo=UTC)
