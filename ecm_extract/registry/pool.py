"""The releases among which is chosen: of what is requested and of all that they may depend on, the best first."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ecm_checker.hub.package import Package
from ecm_checker.versions import in_range
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.problem import Option, Place, Problem
from ecm_extract.registry.releases import package_of_release
from ecm_extract.registry.tables import Dependency, Release, Standing
from ecm_extract.registry.wishes import Wish


class Pool:
    """Releases of families, each at its place: those that are not deprecated first, then the newest.

    Attributes:
        wishes: what is requested.
        releases: by family, with where they stand. needs: ranges by package, by the id of the release.
    """

    def __init__(self, session: Session, wishes: Sequence[Wish]) -> None:
        """Load what may be chosen.

        Raises:
            InputError: a requested package is not stored.
        """
        self._session, self.wishes = session, tuple(wishes)
        self.releases: dict[str, list[tuple[Release, Standing]]] = {}
        self.needs: dict[int, dict[str, str]] = {}
        self._packages: dict[Place, Package] = {}
        self._load()

    def release(self, place: Place) -> Release:
        """Return the release at a place."""
        return self.releases[place.family][place.number][0]

    def needs_of(self, place: Place) -> Mapping[str, str]:
        """Return the ranges of what the release at a place depends on."""
        return self.needs[self.release(place).id]

    def package(self, place: Place) -> Package:
        """Return what is stored of the release at a place."""
        if place not in self._packages:
            self._packages[place] = package_of_release(self._session, self.release(place))
        return self._packages[place]

    def problem(self, excluded: frozenset[Place], clashes: frozenset[tuple[Place, Place]]) -> Problem:
        """Return the choice, without what was found out to be refused."""
        families = {
            package: [Option(release.version, self._places(release)) for release, _ in rows]
            for package, rows in sorted(self.releases.items())
        }
        requests: dict[str, frozenset[int]] = {}
        for wish in self.wishes:
            places = self._in_range(wish.package, wish.wanted)
            requests[wish.package] = requests.get(wish.package, places) & places
        return Problem(families, requests, excluded, clashes)

    def _load(self) -> None:
        waiting = [wish.package for wish in self.wishes]
        for package in waiting:
            if not self._found(package):
                message = f"{package} is not in the registry"
                raise InputError(message, "`ecm-extract registry list` tells what is")
        while waiting:
            for release, _ in self.releases[waiting.pop()]:
                rows = self._session.scalars(select(Dependency).filter_by(release_id=release.id))
                needs = self.needs[release.id] = {row.package: row.wanted for row in rows}
                waiting += [name for name in needs if name not in self.releases and self._found(name)]

    def _found(self, package: str) -> bool:
        """Whether the registry has a package."""
        if package in self.releases:
            return True
        query = select(Release, Standing).join(Standing, Standing.release_id == Release.id)
        query = query.where(Release.package == package, Standing.withdrawn.is_(None)).order_by(Release.rank.desc())
        rows = [(release, standing) for release, standing in self._session.execute(query)]
        if rows:
            self.releases[package] = sorted(rows, key=lambda row: row[1].deprecated is not None)
        return bool(rows)

    def _places(self, release: Release) -> Mapping[str, frozenset[int]]:
        needs = self.needs[release.id]
        return {name: self._in_range(name, wanted) for name, wanted in needs.items() if name in self.releases}

    def _in_range(self, package: str, wanted: str) -> frozenset[int]:
        """Places whose version is in a range; one that cannot be read is not refused for it."""
        rows = enumerate(self.releases[package])
        return frozenset(number for number, (release, _) in rows if in_range(release.version, wanted) is not False)
