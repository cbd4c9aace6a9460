"""Whether what gates decided, and what they stood on, is what the audit log tells: nothing came in beside it."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterator

import msgspec
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.registry.publish import FIRST_CHANNEL
from ecm_extract.registry.releases import name_of
from ecm_extract.registry.tables import AuditEntry, EvidenceRow, MigrationRow, Release, Standing, WaiverRow


class _Detail(msgspec.Struct):
    """What entries of the log say of decisions."""

    to: str = ""
    refused: tuple[str, ...] = ()
    digest: str = ""
    gate: str = ""
    name: str = ""
    reason: str = ""
    ends: str = ""


class _Told:
    """What the log tells, by release."""

    def __init__(self, session: Session) -> None:
        self.channels: dict[str, str | None] = {}
        self.evidence: set[tuple[str, str]] = set()
        self.migrations: dict[str, str] = {}
        self.waivers: Counter[tuple[str, ...]] = Counter()
        for entry in session.scalars(select(AuditEntry).order_by(AuditEntry.number)):
            self._take(entry)

    def _take(self, entry: AuditEntry) -> None:
        try:
            detail = msgspec.json.decode(entry.detail, type=_Detail)
        except msgspec.MsgspecError:  # the chain tells that it was changed
            return
        subject = entry.subject
        if entry.action in _CHANNEL:
            self.channels[subject] = _CHANNEL[entry.action]
        elif entry.action == "demote" or (entry.action == "promote" and not detail.refused):
            self.channels[subject] = detail.to
        elif entry.action == "evidence":
            self.evidence.add((subject, detail.digest))
        elif entry.action == "migration":
            self.migrations[subject] = detail.digest
        elif entry.action == "waive":
            self.waivers[subject, detail.to, detail.gate, detail.name, detail.reason, detail.ends] += 1


_CHANNEL = {"publish": FIRST_CHANNEL, "withdraw": None}


def undecided(session: Session) -> Iterator[str]:
    """Yield releases whose channel, evidence, migration or waivers are not those of the log."""
    told = _Told(session)
    yield from _channels(session, told)
    yield from _evidence(session, told)
    yield from _migrations(session, told)
    yield from _waivers(session, told)


def _channels(session: Session, told: _Told) -> Iterator[str]:
    for release, standing in session.execute(select(Release, Standing).join(Standing)):
        expected = told.channels.get(name_of(release))
        if standing.channel != expected:
            yield f"{name_of(release)} is in {standing.channel}, and the log leads it to {expected}"


def _evidence(session: Session, told: _Told) -> Iterator[str]:
    for release, row in session.execute(select(Release, EvidenceRow).join(EvidenceRow)):
        if hashlib.sha256(row.document.encode()).hexdigest() != row.digest:
            yield f"{name_of(release)}: evidence {row.digest[:12]} was changed"
        elif (name_of(release), row.digest) not in told.evidence:
            yield f"{name_of(release)}: evidence {row.digest[:12]} came in beside the log"


def _migrations(session: Session, told: _Told) -> Iterator[str]:
    for release, row in session.execute(select(Release, MigrationRow).join(MigrationRow)):
        if told.migrations.get(name_of(release)) != hashlib.sha256(row.document.encode()).hexdigest():
            yield f"{name_of(release)}: its migration is not the one that was kept"


def _waivers(session: Session, told: _Told) -> Iterator[str]:
    for release, row in session.execute(select(Release, WaiverRow).join(WaiverRow)):
        waiver = (name_of(release), row.channel, row.gate, row.name, row.reason, row.ends)
        told.waivers[waiver] -= 1
        if told.waivers[waiver] < 0:
            yield f"{name_of(release)}: a waiver of the {row.gate} gate came in beside the log"
