"""Publishing: packages become releases, all of a source in one transaction, and never change again."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, Final, Literal

import msgspec
from ecm_checker.hub.package import Package
from sqlalchemy import insert, select
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry import audit
from ecm_extract.registry.contents import Packed, pack
from ecm_extract.registry.dependencies import dependencies_of
from ecm_extract.registry.gaps import gaps_of
from ecm_extract.registry.groups import grouped
from ecm_extract.registry.parts import PackedPart, clipped, pack_part, parts_of
from ecm_extract.registry.tables import (
    Base,
    Content,
    Dependency,
    Gap,
    Holds,
    Name,
    Part,
    ProvisionRow,
    Release,
    RequirementKey,
    RequirementRow,
    Standing,
)
from ecm_extract.registry.versions import rank
from ecm_extract.registry.words import searched_words

FIRST_CHANNEL: Final = "sandbox"
State = Literal["published", "same", "refused"]


class Origin(msgspec.Struct, frozen=True):
    """Where packages were read: name of the repository, its tag and commit where it has one."""

    repository: str
    tag: str | None = None
    commit: str | None = None


class Ready(msgspec.Struct, frozen=True):
    """A package with all that is stored of it, made before the transaction begins."""

    package: Package
    content: Packed
    parts: tuple[PackedPart, ...]
    dependencies: dict[str, str]
    gaps: list[dict[str, Any]]


class Published(msgspec.Struct, frozen=True):
    """What became of a package.

    Attributes:
        version: empty when it declares none.
        state: `same` when it was there already with this content.
        reason: why it was refused.
    """

    package: str
    version: str
    state: State
    reason: str = ""

    @property
    def release(self) -> str:
        """`package@version`."""
        return f"{self.package}@{self.version}"


def make_ready(package: Package) -> Ready:
    """Return a package as it is stored."""
    parts = tuple(pack_part(part) for part in parts_of(package))
    needs = {clipped(name): wanted for name, wanted in dependencies_of(package.contracts()).items()}
    return Ready(package, pack(package), parts, needs, gaps_of(package))


def publish(session: Session, packages: Sequence[Ready], origin: Origin) -> list[Published]:
    """Store releases in the transaction of a session; those that are refused leave the others alone.

    Args:
        session: one that writes.
        packages: of one source.
        origin: of all of them.
    """
    return [_one(session, each, origin) for each in packages]


def require_all(published: Sequence[Published]) -> None:
    """Make sure that nothing was refused.

    Raises:
        InputError: something was; the message tells what and why.
    """
    refused = [each for each in published if each.state == "refused"]
    if refused:
        message = "; ".join(f"{each.release}: {each.reason}" for each in refused)
        raise InputError(message, "a release that is stored never changes: release it under a new version")


def _one(session: Session, ready: Ready, origin: Origin) -> Published:
    package = ready.package
    if not package.version:
        return Published(package.name, package.version or "", "refused", "its package.xml declares no version")
    held = session.scalars(select(Release).filter_by(package=package.name, version=package.version)).one_or_none()
    if held is not None:
        return _again(held, ready.content.digest, origin)
    _store(session, ready, origin)
    return Published(package.name, package.version, "published")


def _again(held: Release, digest: str, origin: Origin) -> Published:
    """A release that is there already is the same, or another one under its name."""
    if held.digest == digest:
        return Published(held.package, held.version, "same")
    here = _told(origin.tag, origin.commit, origin.repository)
    moved = "its tag moved: " if origin.tag is not None and origin.tag == held.tag else ""
    reason = f"{moved}it is stored with other content from {_told(held.tag, held.commit, held.repository)}, not {here}"
    return Published(held.package, held.version, "refused", reason)


def _told(tag: str | None, commit: str | None, repository: str) -> str:
    at = " ".join(filter(None, (tag, commit[:12] if commit else None)))
    return f"{repository} {at}".strip()


def _store(session: Session, ready: Ready, origin: Origin) -> None:
    package, content = ready.package, ready.content
    if session.get(Content, content.digest) is None:
        session.add(Content(digest=content.digest, data=content.data, size=content.size))
        session.flush()
    detail = {"digest": content.digest, "commit": origin.commit, "tag": origin.tag, "repository": origin.repository}
    at = audit.append(session, "publish", f"{package.name}@{package.version}", detail)
    release = Release(
        package=package.name,
        version=package.version,
        rank=rank(package.version or ""),
        ros=package.ros,
        repository=origin.repository,
        path=package.path,
        tag=origin.tag,
        commit=origin.commit,
        stored=at,
        digest=content.digest,
    )
    session.add(release)
    session.flush()
    session.add(Standing(release_id=release.id, channel=FIRST_CHANNEL, since=at))
    needs = [{"release_id": release.id, "package": k, "wanted": v} for k, v in sorted(ready.dependencies.items())]
    _insert(session, Dependency, needs)
    _insert(session, Gap, [{"release_id": release.id, **each} for each in ready.gaps])
    _insert(session, Holds, [{"release_id": release.id, "part_id": each} for each in _part_ids(session, ready.parts)])


def _part_ids(session: Session, parts: Sequence[PackedPart]) -> list[int]:
    """Return the ids of parts; those that no release had before are stored."""
    known = _known(session, parts)
    _add_names(session, (row["name"] for part in parts if part.digest not in known for row in part.provisions))
    for part in parts:
        if part.digest not in known:
            row = Part(digest=part.digest, data=part.data)
            session.add(row)
            session.flush()
            known[part.digest] = row.id
            for table, rows in (
                (ProvisionRow, part.provisions),
                (RequirementRow, part.requirements),
                (RequirementKey, part.keys),
            ):
                _insert(session, table, [{"part_id": row.id, **each} for each in rows])
    return sorted({known[part.digest] for part in parts})


def _add_names(session: Session, provided: Iterable[str]) -> None:
    """Keep names that nobody provided before."""
    names = sorted(set(provided))
    for group in grouped(names):
        known = set(session.scalars(select(Name.name).where(Name.name.in_(group))))
        new = [each for each in group if each not in known]
        _insert(session, Name, [{"name": each, "words": searched_words(each)} for each in new])


def _known(session: Session, parts: Sequence[PackedPart]) -> dict[str, int]:
    found: dict[str, int] = {}
    for group in grouped([part.digest for part in parts]):
        rows = session.execute(select(Part.digest, Part.id).where(Part.digest.in_(group)))
        found |= {row.digest: row.id for row in rows}
    return found


def _insert(session: Session, table: type[Base], rows: list[dict[str, Any]]) -> None:
    if rows:
        session.execute(insert(table), rows)
