"""Names by their words: the full-text index of the database, FTS5 of SQLite or that of PostgreSQL."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

import msgspec
from sqlalchemy import Row, Select, func, select, text
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.groups import grouped
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
    names = session.scalars(_matching(session, phrases)).all()
    releases = {each.id: each for each in session.scalars(select(Release).where(Release.id.in_(scope.query())))}
    found = {
        FoundName(row.name, row.kind, row.owner, release.package, release.version, row.type or "")
        for row in _provided(session, names, kind)
        if (release := releases.get(row.release_id)) is not None
    }
    return sorted(
        found, key=lambda each: (len(words_of(each.name)), len(each.name), each.name, each.package, each.owner)
    )


def _words(searched: str) -> list[str]:
    found = words_of(searched)
    if not found:
        message = f"there is no word in {searched!r}"
        raise InputError(message, "search for letters and digits: `cmd_vel`, `NavigateToPose`")
    return found


def _matching(session: Session, phrases: Sequence[Sequence[str]]) -> Select[str]:
    if session.get_bind().dialect.name == "sqlite":
        words = " AND ".join(f'"{" ".join(phrase)}" *' for phrase in phrases)
        return select(Name.name).where(Name.id.in_(_FTS5.bindparams(words=words)))
    words = " & ".join(f"({' <-> '.join(phrase)}:*)" for phrase in phrases)
    return select(Name.name).where(
        func.to_tsvector(text("'simple'"), Name.words).op("@@")(func.to_tsquery("simple", words))
    )


def _provided(
    session: Session, names: Sequence[str], kind: str | None
) -> Iterator[Row[str, str, str, str | None, int]]:
    """Rows of all releases: those of a name are few, and asked for by the name alone they are found by its index."""
    columns = ProvisionRow.name, ProvisionRow.kind, ProvisionRow.owner, ProvisionRow.type
    for group in grouped(names):
        query = select(*columns, Holds.release_id).join(Holds, Holds.part_id == ProvisionRow.part_id)
        query = query.where(ProvisionRow.name.in_(group))
        yield from session.execute(query if kind is None else query.where(ProvisionRow.kind == kind))
