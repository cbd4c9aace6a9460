"""Which releases are there: one by its name, the newest of a package, or those that belong together."""

from __future__ import annotations

import difflib
from collections.abc import Sequence

import msgspec
from ecm_checker.hub.package import Package
from sqlalchemy import ColumnElement, Select, func, select
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.contents import unpack
from ecm_extract.registry.tables import Content, Release, Standing


class ReleaseInfo(msgspec.Struct, frozen=True):
    """A release as it is listed; times are ISO 8601, `channel` is None once it is withdrawn."""

    package: str
    version: str
    channel: str | None
    repository: str
    tag: str | None
    commit: str | None
    stored: str
    digest: str
    deprecated: str | None = None
    reason: str | None = None
    successor: str | None = None
    withdrawn: str | None = None

    @property
    def name(self) -> str:
        """`package@version`."""
        return f"{self.package}@{self.version}"


def name_of(release: Release) -> str:
    """Return `package@version`."""
    return f"{release.package}@{release.version}"


def find_release(session: Session, spec: str) -> Release:
    """Return the release that `package@version` names, or the newest of `package`.

    Raises:
        InputError: it is not stored; the hint names what is.
    """
    package, _, version = spec.partition("@")
    wanted = select(Release).filter_by(package=package)
    if version:
        found = session.scalars(wanted.filter_by(version=version)).one_or_none()
    else:
        found = session.scalars(_standing(wanted).order_by(Release.rank.desc()).limit(1)).one_or_none()
    if found is None:
        message = f"{spec} is not in the registry"
        raise InputError(message, _nearest(session, package))
    return found


def release_before(session: Session, release: Release) -> Release | None:
    """Return the newest release of the package that is older; None for its first one."""
    older = select(Release).where(Release.package == release.package, Release.rank < release.rank)
    return session.scalars(_standing(older).order_by(Release.rank.desc()).limit(1)).one_or_none()


def _standing(wanted: Select[Release]) -> Select[Release]:
    """Leave out what was withdrawn."""
    return wanted.join(Standing, Standing.release_id == Release.id).where(Standing.withdrawn.is_(None))


def _nearest(session: Session, package: str) -> str:
    versions = session.scalars(select(Release.version).filter_by(package=package).order_by(Release.rank.desc())).all()
    if versions:
        return f"stored of {package}: {', '.join(versions[:5])}"
    near = difflib.get_close_matches(package, session.scalars(select(Release.package).distinct()).all(), 3)
    return f"did you mean {', '.join(near)}?" if near else "publish it with `ecm-extract registry publish`"


def newest_ids(*conditions: ColumnElement[bool]) -> Select[int]:
    """Return the query of the newest release of each package that was not withdrawn and fits conditions."""
    place = func.row_number().over(partition_by=Release.package, order_by=Release.rank.desc()).label("place")
    rows = (
        select(Release.id, place)
        .join(Standing, Standing.release_id == Release.id)
        .where(Standing.withdrawn.is_(None), *conditions)
        .subquery()
    )
    return select(rows.c.id).where(rows.c.place == 1)


def list_releases(session: Session, package: str | None = None, newest: bool = False) -> Sequence[ReleaseInfo]:
    """Return releases by package and version.

    Args:
        session: one that reads.
        package: whose; None for all.
        newest: only the newest of each package.
    """
    query = select(Release, Standing).join(Standing, Standing.release_id == Release.id)
    if package is not None:
        query = query.where(Release.package == package)
    if newest:
        query = query.where(Release.id.in_(newest_ids()))
    rows = session.execute(query.order_by(Release.package, Release.rank))
    return [info(release, standing) for release, standing in rows]


def info(release: Release, standing: Standing) -> ReleaseInfo:
    """Return a release as it is listed."""
    fields = ("package", "version", "repository", "tag", "commit", "stored", "digest")
    state = ("channel", "deprecated", "reason", "successor", "withdrawn")
    return ReleaseInfo(
        **{name: getattr(release, name) for name in fields},
        **{name: getattr(standing, name) for name in state},
    )


def package_of_release(session: Session, release: Release) -> Package:
    """Return what is stored of a release.

    Raises:
        ToolError: it is damaged.
    """
    content = session.get_one(Content, release.digest)
    return unpack(content.data, content.digest, release.repository, release.commit)
