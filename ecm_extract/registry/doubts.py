"""What is not known of the releases that are asked: files that were not read, and names that are computed."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.gaps import with_gaps
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.provision import HOLE, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.provisions import last_part
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.registry.gaps import gaps_of
from ecm_extract.registry.impact_side import Side
from ecm_extract.registry.releases import name_of
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.tables import Gap, Holds, Release, RequirementRow
from ecm_extract.registry.users import requirements_by_part

_COMPUTED: Final = re.compile(r"\{[^{}]*\}")


class Doubt(msgspec.Struct, frozen=True, order=True):
    """A place that may use what is asked about, or hide it: `line` is 0 for a whole file or folder."""

    release: str
    path: str
    line: int
    why: str


def doubts_of(
    session: Session, names: Sequence[Provision], scope: Scope, beside: Collection[str] = ()
) -> tuple[Doubt, ...]:
    """Return what of a scope may use names without anybody knowing.

    Args:
        session: one that reads.
        names: that are asked about; nobody can use none.
        scope: the releases that are asked.
        beside: packages that are not asked.
    """
    if not names:
        return ()
    found = [*_unread(session, scope, beside), *_computed(session, names, scope, beside)]
    return tuple(sorted(dict.fromkeys(found)))


def unread_of(*sides: Side) -> Iterator[Doubt]:
    """Yield what was not read of releases that are asked about themselves."""
    for side in sides:
        yield from (_not_read(side.label, row["path"], row["reason"]) for row in gaps_of(side.package))


def _not_read(release: str, path: str, reason: str) -> Doubt:
    return Doubt(release, path, 0, f"was not read: {reason}")


def _unread(session: Session, scope: Scope, beside: Collection[str]) -> Iterator[Doubt]:
    """Of a tree that several packages share each place is told once."""
    rows = session.execute(
        select(Release, Gap.path, Gap.reason)
        .join(Gap, Gap.release_id == Release.id)
        .where(Release.id.in_(scope.query()))
        .order_by(Release.package)
    )
    told: set[tuple[str, str | None, str]] = set()
    for release, path, reason in rows:
        place = release.repository, release.commit, path
        if release.package not in beside and place not in told:
            told.add(place)
            yield _not_read(name_of(release), path, reason)


def _computed(session: Session, names: Sequence[Provision], scope: Scope, beside: Collection[str]) -> Iterator[Doubt]:
    by_use = _by_use(names)
    rows = session.execute(
        select(Release, RequirementRow.part_id, RequirementRow.number)
        .join(Holds, Holds.release_id == Release.id)
        .join(RequirementRow, RequirementRow.part_id == Holds.part_id)
        .where(RequirementRow.use.in_(by_use), RequirementRow.certainty == "unknown")
        .where(Release.id.in_(scope.query()))
    ).all()
    parts = requirements_by_part(session, {row.part_id for row in rows})
    for release, part, number in rows:
        entry = parts[part][number]
        if release.package not in beside and any(_may_mean(entry, each) for each in by_use[entry.use]):
            yield from _lines(name_of(release), entry)


def _by_use(names: Sequence[Provision]) -> dict[str, list[Provision]]:
    """The names that each use could be of, of those uses that have any."""
    found = {
        use: [each for each in names if each.kind in row.of and row.facet in {"", each.facet}]
        for use, row in uses().items()
    }
    return {use: meant for use, meant in found.items() if meant}


def _lines(release: str, entry: Requirement) -> Iterable[Doubt]:
    return (Doubt(release, at.path, at.line, f"{entry.phrase}, a name that is computed") for at in entry.evidence)


def _may_mean(entry: Requirement, provision: Provision) -> bool:
    """Whether a computed name could come out as a name that its use may be of: by its last part and its type."""
    if entry.type and provision.type and last_part(entry.type) != last_part(provision.type):
        return False
    offered, used = last_part(provision.name), entry.name.rpartition("/")[2]
    pattern = with_gaps([re.escape(part) for part in _COMPUTED.split(used)], ".*")
    return HOLE in offered or re.fullmatch(pattern, offered) is not None
