"""What the registry stores, as tables.

What a file of a package provides and requires is stored once for all releases that have it alike (`Part`), so that
the hundredth release of a package costs only what changed in it. Times are ISO 8601 in UTC, which sorts as text.
"""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

from sqlalchemy import ForeignKey, Index, LargeBinary, Text, UniqueConstraint
from sqlalchemy.orm import DeclarativeBase, Mapped, mapped_column

_Key = Annotated[str, mapped_column(primary_key=True)]
_Number = Annotated[int, mapped_column(primary_key=True)]
_OfPart = Annotated[int, mapped_column(ForeignKey("part.id"), primary_key=True)]
_OfRelease = Annotated[int, mapped_column(ForeignKey("release.id"), primary_key=True)]
_AboutRelease = Annotated[int, mapped_column(ForeignKey("release.id"), index=True)]
"""Columns of several tables: keys, and which part or release a row is of."""


class Base(DeclarativeBase):
    """Base of all tables."""

    type_annotation_map: ClassVar[dict[Any, Any]] = {str: Text, bytes: LargeBinary}


class Content(Base):
    """A document by the SHA-256 of its canonical JSON; `data` is compressed, `size` is that of the JSON."""

    __tablename__ = "content"
    digest: Mapped[_Key]
    data: Mapped[bytes]
    size: Mapped[int]


class Release(Base):
    """A package at a version; a row never changes.

    Attributes:
        rank: sorts as versions do.
        repository, path, tag, commit: where it was read; a folder without git has neither tag nor commit.
        released: date of the commit. stored: when it came here.
        digest: of its document.
    """

    __tablename__ = "release"
    id: Mapped[_Number]
    package: Mapped[str]
    version: Mapped[str]
    rank: Mapped[str]
    ros: Mapped[int | None]
    repository: Mapped[str]
    path: Mapped[str]
    tag: Mapped[str | None]
    commit: Mapped[str | None]
    stored: Mapped[str]
    digest: Mapped[str] = mapped_column(ForeignKey("content.digest"))
    __table_args__ = (
        UniqueConstraint("package", "version"),
        Index("release_newest", "package", "rank"),
        Index("release_of_repository", "repository", "commit"),
    )


class Dependency(Base):
    """A package that a release depends on, with the range of versions that it names; `*` for any."""

    __tablename__ = "dependency"
    release_id: Mapped[_OfRelease]
    package: Mapped[str] = mapped_column(primary_key=True, index=True)
    wanted: Mapped[str]


class Part(Base):
    """What one file of a package provides and requires; `data` holds the requirements, compressed."""

    __tablename__ = "part"
    id: Mapped[_Number]
    digest: Mapped[str] = mapped_column(unique=True)
    data: Mapped[bytes]


class Holds(Base):
    """A release has a part."""

    __tablename__ = "holds"
    part_id: Mapped[_OfPart]
    release_id: Mapped[int] = mapped_column(ForeignKey("release.id"), primary_key=True, index=True)
    __table_args__ = ({"sqlite_with_rowid": False},)


class ProvisionRow(Base):
    """One public name that a part provides; `last` is the last part of the name."""

    __tablename__ = "provision"
    part_id: Mapped[_OfPart]
    number: Mapped[_Number]
    kind: Mapped[str]
    owner: Mapped[str]
    name: Mapped[str]
    last: Mapped[str]
    type: Mapped[str | None]
    line: Mapped[int]
    __table_args__ = (
        Index("provision_by_name", "name", "kind"),
        Index("provision_by_last", "last", "kind"),
        {"sqlite_with_rowid": False},
    )


class RequirementRow(Base):
    """One name that a part depends on; `number` is its place in the part, `package` the one that must provide it."""

    __tablename__ = "requirement"
    part_id: Mapped[_OfPart]
    number: Mapped[_Number]
    use: Mapped[str]
    kind: Mapped[str]
    package: Mapped[str | None]
    owner: Mapped[str]
    name: Mapped[str]
    line: Mapped[int]
    certainty: Mapped[str]
    __table_args__ = (
        Index("requirement_of_package", "package", "kind"),
        Index("requirement_of_use", "use"),
        {"sqlite_with_rowid": False},
    )


class Name(Base):
    """A name that some part provides, with the words by which it is searched; the database keeps their index."""

    __tablename__ = "name"
    id: Mapped[_Number]
    name: Mapped[str] = mapped_column(unique=True)
    words: Mapped[str]


class Gap(Base):
    """A file or folder of a release that was not read, so that it may use any name."""

    __tablename__ = "gap"
    release_id: Mapped[_OfRelease]
    path: Mapped[_Key]
    reason: Mapped[str]


class RequirementKey(Base):
    """What a requirement is found by: the keys by which matching looks for what it may mean."""

    __tablename__ = "requirement_key"
    key: Mapped[_Key]
    use: Mapped[_Key]
    part_id: Mapped[_OfPart]
    number: Mapped[_Number]
    __table_args__ = ({"sqlite_with_rowid": False},)


class Standing(Base):
    """Where a release stands: its channel, and its way out.

    Attributes:
        channel: a row of the table of channels; None once it is withdrawn.
        deprecated: since when; None when it is not. reason: of the deprecation. successor: what to use instead.
        withdrawn: since when.
    """

    __tablename__ = "standing"
    release_id: Mapped[_OfRelease]
    channel: Mapped[str | None] = mapped_column(index=True)
    since: Mapped[str]
    deprecated: Mapped[str | None]
    reason: Mapped[str | None]
    successor: Mapped[str | None]
    withdrawn: Mapped[str | None]


class Running(Base):
    """Which release of a package an environment runs."""

    __tablename__ = "running"
    environment: Mapped[_Key]
    package: Mapped[_Key]
    release_id: Mapped[int] = mapped_column(ForeignKey("release.id"))
    since: Mapped[str]


class EvidenceRow(Base):
    """Something observed or tested of a release; `document` is JSON."""

    __tablename__ = "evidence"
    digest: Mapped[_Key]
    release_id: Mapped[int] = mapped_column(ForeignKey("release.id"), primary_key=True, index=True)
    document: Mapped[str]


class MigrationRow(Base):
    """How consumers follow a release that breaks them; `document` is JSON."""

    __tablename__ = "migration"
    release_id: Mapped[_OfRelease]
    document: Mapped[str]


class WaiverRow(Base):
    """Somebody answers for a gate that a release does not pass."""

    __tablename__ = "waiver"
    id: Mapped[_Number]
    release_id: Mapped[_AboutRelease]
    channel: Mapped[str]
    gate: Mapped[str]
    name: Mapped[str]
    reason: Mapped[str]
    ends: Mapped[str]


class VerdictRow(Base):
    """What the gates said of a release: `document` is JSON with all that they stood on."""

    __tablename__ = "verdict"
    id: Mapped[_Number]
    release_id: Mapped[_AboutRelease]
    channel: Mapped[str]
    at: Mapped[str]
    passed: Mapped[bool]
    document: Mapped[str]


class Indexed(Base):
    """A tag of a repository that was indexed: what came of it, and why when nothing did."""

    __tablename__ = "indexed"
    repository: Mapped[_Key]
    tag: Mapped[_Key]
    commit: Mapped[str]
    releases: Mapped[int]
    skipped: Mapped[str]
    at: Mapped[str]


class AuditEntry(Base):
    """One change of the registry; `digest` is over all other fields, `previous` that of the entry before."""

    __tablename__ = "audit"
    number: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    at: Mapped[str]
    actor: Mapped[str]
    action: Mapped[str]
    subject: Mapped[str]
    detail: Mapped[str]
    previous: Mapped[str]
    digest: Mapped[str]


class AuditHead(Base):
    """The newest entry of the audit log; who changes anything locks this row first."""

    __tablename__ = "audit_head"
    id: Mapped[int] = mapped_column(primary_key=True, autoincrement=False)
    number: Mapped[int]
    at: Mapped[str]
    digest: Mapped[str]
