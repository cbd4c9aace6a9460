"""Names by their words: the full-text index of the database, FTS5 of SQLite or that of PostgreSQL."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import msgspec
from sqlalchemy import Select, func, select, text
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.tables import Holds, Name, ProvisionRow, Release
from ecm_extract.registry.words import words_of

_FTS5: Final = text("SELECT rowid FROM name_search WHERE name_search MATCH :words").columns(Name.id)


class FoundName(msgspec.Struct, frozen=True, order=True):
    """A public name and the release that provides it; `owner` is the node, class or message that has it."""

    name: str
    kind: str
    owner: str
    package: str
    version: str
    type: str = ""


def search(session: Session, texts: Sequence[str], scope: Scope, kind: str | None = None) -> list[FoundName]:
    """Return the names that have all texts in them, shortest first.

    Args:
        session: one that reads.
        texts: each is found where its words stand together and the last one begins a word: `cmd_v` in `/cmd_vel`.
        scope: the releases whose names are searched.
        kind: only names of this kind.

    Raises:
        InputError: a text has no word in it.
    """
    phrases = [_words(each) for each in texts]
    rows = session.execute(_query(_matching(session, phrases), scope, kind))
    found = {FoundName(row.name, row.kind, row.owner, row.package, row.version, row.type or "") for row in rows}
    return sorted(
        found, key=lambda each: (len(words_of(each.name)), len(each.name), each.name, each.package, each.owner)
    )


def _words(searched: str) -> list[str]:
    found = words_of(searched)
    if not found:
        message = f"there is no word in {searched!r}"
        raise InputError(message, "search for letters and digits: `cmd_vel`, `NavigateToPose`")
    return found


def _matching(session: Session, phrases: Sequence[Sequence[str]]) -> Select[int]:
    if session.get_bind().dialect.name == "sqlite":
        words = " AND ".join(f'"{" ".join(phrase)}" *' for phrase in phrases)
        return select(Name.id).where(Name.id.in_(_FTS5.bindparams(words=words)))
    words = " & ".join(f"({' <-> '.join(phrase)}:*)" for phrase in phrases)
    return select(Name.id).where(
        func.to_tsvector(text("'simple'"), Name.words).op("@@")(func.to_tsquery("simple", words))
    )


def _query(matching: Select[int], scope: Scope, kind: str | None) -> Select[str, str, str, str | None, str, str]:
    columns = ProvisionRow.name, ProvisionRow.kind, ProvisionRow.owner, ProvisionRow.type
    query = (
        select(*columns, Release.package, Release.version)
        .join(Name, Name.name == ProvisionRow.name)
        .join(Holds, Holds.part_id == ProvisionRow.part_id)
        .join(Release, Release.id == Holds.release_id)
        .where(Name.id.in_(matching), Release.id.in_(scope.query()))
    )
    return query if kind is None else query.where(ProvisionRow.kind == kind)
