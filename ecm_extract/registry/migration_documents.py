"""Migrations of releases: how those who use a release follow it."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import Final

import msgspec
from sqlalchemy.orm import Session

from ecm_extract.diff.migration import Migration
from ecm_extract.errors import InputError
from ecm_extract.registry import audit
from ecm_extract.registry.releases import find_release, name_of
from ecm_extract.registry.tables import MigrationRow

_MAX_BYTES: Final = 50_000_000


def read_migration(file: str) -> Migration:
    """Read a migration.

    Raises:
        InputError: the file cannot be read, or is none.
    """
    place = Path(file)
    try:
        data = place.read_bytes() if place.stat().st_size <= _MAX_BYTES else b""
        return msgspec.json.decode(data, type=Migration)
    except OSError as error:
        message = f"cannot read {file}: {error.strerror}"
        raise InputError(message) from error
    except msgspec.MsgspecError as error:
        message = f"{file}: {error}"
        raise InputError(message, "write it with `ecm-extract diff OLD NEW --format migration-spec`") from error


def keep_migration(session: Session, spec: str, migration: Migration) -> str:
    """Keep the migration of a release, in the place of an earlier one, and return the release.

    Raises:
        InputError: the release is not stored.
    """
    release = find_release(session, spec)
    document = msgspec.json.encode(migration, order="deterministic").decode()
    session.merge(MigrationRow(release_id=release.id, document=document))
    digest = hashlib.sha256(document.encode()).hexdigest()
    audit.append(session, "migration", name_of(release), {"steps": len(migration.steps), "digest": digest})
    return name_of(release)


def migration_of_release(session: Session, release_id: int) -> Migration | None:
    """Return the migration of a release; None where it has none."""
    row = session.get(MigrationRow, release_id)
    return msgspec.json.decode(row.document, type=Migration) if row is not None else None
