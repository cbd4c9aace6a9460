"""Whether what is stored is as it was stored: contents by their hash, the audit log by its chain, decisions by it."""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from sqlalchemy import func, select
from sqlalchemy.orm import Session

from ecm_extract.errors import ToolError
from ecm_extract.registry import audit
from ecm_extract.registry.contents import unpack
from ecm_extract.registry.decisions import undecided
from ecm_extract.registry.parts import requirements_of
from ecm_extract.registry.publish import make_ready
from ecm_extract.registry.releases import name_of
from ecm_extract.registry.tables import AuditEntry, Content, Gap, Holds, Part, Release, RequirementRow


class Verified(msgspec.Struct, frozen=True):
    """What was looked at, and what is wrong; nothing is when `problems` is empty."""

    releases: int
    entries: int
    problems: tuple[str, ...]


def verify(session: Session) -> Verified:
    """Look at everything that is stored."""
    problems = [*audit.broken_links(session), *_releases(session), *_unlogged(session), *_parts(session)]
    problems += undecided(session)
    releases = session.scalar(select(func.count()).select_from(Release)) or 0
    entries = session.scalar(select(func.count()).select_from(AuditEntry)) or 0
    return Verified(releases, entries, tuple(problems))


def _releases(session: Session) -> Iterator[str]:
    rows = session.execute(select(Release, Content).join(Content, Content.digest == Release.digest))
    for release, content in rows.yield_per(50):
        try:
            package = unpack(content.data, content.digest, release.repository, release.commit)
        except ToolError as error:
            yield f"{name_of(release)}: {error.message}"
            continue
        ready = make_ready(package)
        wanted = {part.digest for part in ready.parts}
        held = select(Part.digest).join(Holds, Holds.part_id == Part.id).where(Holds.release_id == release.id)
        gaps = select(Gap.path).where(Gap.release_id == release.id)
        if wanted != set(session.scalars(held)) or {each["path"] for each in ready.gaps} != set(session.scalars(gaps)):
            yield f"{name_of(release)}: what can be asked of it is not what its document says"


def _unlogged(session: Session) -> Iterator[str]:
    """Releases that no entry of the log tells, and entries whose release is gone or another one."""
    query = select(AuditEntry.subject, AuditEntry.detail).where(AuditEntry.action == "publish")
    told = {row.subject: _digest(row.detail) for row in session.execute(query)}
    held = {name_of(each): each.digest for each in session.scalars(select(Release))}
    for name in sorted(told.keys() | held.keys()):
        if told.get(name) != held.get(name):
            yield f"{name} is not what was published"


class _Detail(msgspec.Struct):
    digest: str = ""


def _digest(detail: str) -> str:
    try:
        return msgspec.json.decode(detail, type=_Detail).digest
    except msgspec.MsgspecError:  # the chain tells that it was changed
        return ""


def _parts(session: Session) -> Iterator[str]:
    counted = select(RequirementRow.part_id, func.count().label("rows")).group_by(RequirementRow.part_id).subquery()
    rows = session.execute(select(Part, counted.c.rows).outerjoin(counted, counted.c.part_id == Part.id))
    for part, count in rows.yield_per(200):
        if len(requirements_of(part.data)) != (count or 0):
            yield f"part {part.id} has other rows than it holds"
