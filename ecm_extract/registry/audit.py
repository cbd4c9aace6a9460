"""The audit log: every change of the registry, each entry with the hash of the one before."""

from __future__ import annotations

import getpass
import hashlib
from collections.abc import Iterator, Mapping
from typing import Any

import msgspec
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.registry import clock
from ecm_extract.registry.tables import AuditEntry, AuditHead


def append(session: Session, action: str, subject: str, detail: Mapping[str, Any]) -> str:
    """Append an entry in the transaction of a change, and return its time.

    Args:
        session: one that writes; it holds the lock of the log.
        action: what was done.
        subject: to which release, environment or tag.
        detail: plain data.

    Raises:
        InputError: the clock went back.
    """
    head = session.get_one(AuditHead, 1)
    entry = AuditEntry(
        number=head.number + 1,
        at=clock.after(head.at, clock.now()),
        actor=_actor(),
        action=action,
        subject=subject,
        detail=msgspec.json.encode(detail, order="deterministic").decode(),
        previous=head.digest,
    )
    entry.digest = digest(entry)
    session.add(entry)
    head.number, head.at, head.digest = entry.number, entry.at, entry.digest
    session.flush()
    return entry.at


def digest(entry: AuditEntry) -> str:
    """Return the SHA-256 over an entry and the hash of the one before."""
    fields = (str(entry.number), entry.at, entry.actor, entry.action, entry.subject, entry.detail, entry.previous)
    return hashlib.sha256(msgspec.json.encode(fields)).hexdigest()


def broken_links(session: Session) -> Iterator[str]:
    """Yield what is wrong with the log: entries that were changed, are missing, or stand before their time."""
    number, previous, at = 0, "", ""
    for entry in session.scalars(select(AuditEntry).order_by(AuditEntry.number)):
        if entry.number != number + 1:
            yield f"audit entry {number + 1} is missing"
        elif entry.previous != previous:
            yield f"audit entry {entry.number} does not follow the one before it"
        if entry.digest != digest(entry):
            yield f"audit entry {entry.number} was changed"
        if entry.at < at:
            yield f"audit entry {entry.number} is older than the one before it"
        number, previous, at = entry.number, entry.digest, entry.at
    head = session.get(AuditHead, 1)
    if head is None or (head.number, head.digest) != (number, previous):
        yield "the newest audit entries are missing"


def _actor() -> str:
    try:
        return getpass.getuser()
    except (OSError, KeyError):  # a container may run under a number that has no name
        return "unknown"
