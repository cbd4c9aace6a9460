"""What is stored of packages that others require names of."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import msgspec
from ecm_checker.hub.kinds import kinds
from ecm_checker.hub.package import Package
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.generated import interface_package
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.outside import Outside
from ecm_extract.registry.releases import package_of_release
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.tables import Release


def outside_of(session: Session, inside: Iterable[Package], scope: Scope) -> Outside:
    """Return what is known of the packages that others require names of.

    Args:
        session: one that reads.
        inside: who requires.
        scope: the releases that are there; of a package that has several of them the newest counts.
    """
    packages = tuple(inside)
    wanted = {name for each in packages for entry in each.requires for name in _homes(entry)}
    wanted -= {each.name for each in packages}
    found = {each.package: each for each in _releases(session, sorted(wanted), scope)}
    return Outside(
        shown=scope.shown,
        packages=tuple(_provider(session, found[name]) for name in sorted(found)),
        unknown=tuple(sorted(wanted - found.keys())),
    )


def _homes(requirement: Requirement) -> Iterator[str]:
    """Packages that may provide a name."""
    generated = interface_package(requirement.name)
    yield from filter(None, (requirement.package, generated))
    if kinds()[requirement.kind].released:
        yield requirement.name


def _releases(session: Session, names: Sequence[str], scope: Scope) -> Sequence[Release]:
    """Oldest first."""
    query = select(Release).where(Release.id.in_(scope.query()), Release.package.in_(names))
    return session.scalars(query.order_by(Release.rank)).all()


def _provider(session: Session, release: Release) -> Package:
    return msgspec.structs.replace(package_of_release(session, release), requires=())
