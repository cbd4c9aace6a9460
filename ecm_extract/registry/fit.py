"""May releases take their place among others: in a channel, or on a robot.

Asked is what breaks there (`impact`), what they depend on and do not find there, and what the robot and its
governance do not allow (`InstallCompat`). What nobody has shown to the registry is said, never passed over.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Final, Literal

import msgspec
from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.match.packages import Packages
from ecm_checker.operations.engine import examine, ready
from ecm_checker.outcome import Outcome, decide, worst
from ecm_checker.profiles import NO_PROFILES, Profiles
from ecm_checker.versions import in_range
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.registry.dependencies import dependencies_of
from ecm_extract.registry.doubts import Doubt, unread_of
from ecm_extract.registry.impact import Impact, impact_of
from ecm_extract.registry.impact_side import Side
from ecm_extract.registry.outside import outside_of
from ecm_extract.registry.releases import name_of
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.sides import TwoSides
from ecm_extract.registry.tables import Dependency, Release

SCHEMA: Final = "ecm-extract/fit/1"
State = Literal["missing", "out_of_range", "unknown"]


class Need(msgspec.Struct, frozen=True):
    """A dependency of a release that is not met: `missing` is known to the registry and not there."""

    release: str
    package: str
    wanted: str
    state: State
    found: str | None = None

    @property
    def text(self) -> str:
        """In words."""
        wanted = "" if self.wanted == "*" else f" {self.wanted}"
        if self.state == "out_of_range":
            return f"{self.release} needs {self.package}{wanted}, and {self.found} is there"
        if self.state == "missing":
            return f"{self.release} needs {self.package}{wanted}, which is not there"
        return f"{self.release} needs {self.package}{wanted}, of which the registry knows nothing"


class Fit(msgspec.Struct, frozen=True):
    """The answer.

    Attributes:
        outcome: the worst that any of the following asks for.
        releases: that are asked about. scope: among whom, in words.
        missing: who belongs there and is not stored. doubts: what was not read of releases that take nobody's place.
        impacts: what breaks there. needs: dependencies that are not met, or of which nothing is known.
        findings: of rules: names that are not provided, what the robot lacks or governance forbids.
    """

    outcome: Outcome
    releases: tuple[str, ...]
    scope: str
    missing: tuple[str, ...]
    doubts: tuple[Doubt, ...]
    impacts: tuple[Impact, ...]
    needs: tuple[Need, ...]
    findings: tuple[Finding, ...]
    schema: str = SCHEMA


def fit(session: Session, pairs: Sequence[TwoSides], scope: Scope, profiles: Profiles = NO_PROFILES) -> Fit:
    """Tell whether releases may take their place.

    Args:
        session: one that reads.
        pairs: the releases, each with the one whose place it takes.
        scope: the releases that are there.
        profiles: of the robot, its governance and what is installed.
    """
    there = _there(session, scope)
    sides = [each.after for each in pairs]
    names = {each.package.name for each in sides}
    impacts = [
        impact_of(session, each.before, each.after, scope, [other for other in sides if other is not each.after])
        for each in pairs
        if each.before is not None
    ]
    stay = {name: release for name, release in there.items() if name not in names}
    needs = [*_needs(session, sides, _versions(sides, stay, profiles)), *_needed(session, sides, stay)]
    findings = (*_unmet(session, sides, stay), *_installed(sides, profiles))
    doubts = tuple(unread_of(*(each.after for each in pairs if each.before is None)))
    known = not scope.missing and not doubts and all(each.is_whole for each in impacts)
    return Fit(
        outcome=worst([_outcome(impacts, needs, findings), "accept" if known else "review"]),
        releases=tuple(each.label for each in sides),
        scope=scope.shown,
        missing=scope.missing,
        doubts=doubts,
        impacts=tuple(impacts),
        needs=tuple(needs),
        findings=findings,
    )


def _there(session: Session, scope: Scope) -> dict[str, Release]:
    found = session.scalars(select(Release).where(Release.id.in_(scope.query())).order_by(Release.rank))
    return {each.package: each for each in found}


def _versions(sides: Sequence[Side], stay: dict[str, Release], profiles: Profiles) -> dict[str, str]:
    """What is there by package: installed on the system, released, or asked about."""
    installed = profiles.runtime.versions if profiles.runtime is not None else {}
    released = {name: release.version for name, release in stay.items()}
    return {**installed, **released, **{each.package.name: each.package.version or "" for each in sides}}


def _needs(session: Session, sides: Sequence[Side], versions: dict[str, str]) -> Iterator[Need]:
    for side in sides:
        for name, wanted in sorted(dependencies_of(side.package.contracts()).items()):
            state = _state(session, versions.get(name), wanted, name)
            if state is not None:
                yield Need(side.label, name, wanted, state, versions.get(name))


def _needed(session: Session, sides: Sequence[Side], stay: dict[str, Release]) -> Iterator[Need]:
    """Who is there and does not take the version of a release."""
    versions = {each.package.name: each.package.version or "" for each in sides}
    names = {release.id: name_of(release) for release in stay.values()}
    for row in session.scalars(select(Dependency).where(Dependency.package.in_(versions))):
        inside = in_range(versions[row.package], row.wanted)
        if row.release_id in names and not inside:
            state: State = "unknown" if inside is None else "out_of_range"
            yield Need(names[row.release_id], row.package, row.wanted, state, versions[row.package])


def _state(session: Session, version: str | None, wanted: str, name: str) -> State | None:
    if version is not None:
        inside = in_range(version, wanted)
        return None if inside else "unknown" if inside is None else "out_of_range"
    known = session.scalars(select(Release.id).filter_by(package=name).limit(1)).first()
    return "unknown" if known is None else "missing"


def _unmet(session: Session, sides: Sequence[Side], stay: dict[str, Release]) -> list[Finding]:
    """Names that the releases need of each other, or of packages that are there, and that those do not provide."""
    packages = [each.package for each in sides]
    there = Scope("", tuple(each.id for each in stay.values()))
    outside = outside_of(session, packages, there)
    return examine("system", Case((), together=True, packages=Packages([*outside.packages, *packages])))


def _installed(sides: Sequence[Side], profiles: Profiles) -> Iterator[Finding]:
    """What the robot lacks or governance forbids; nothing can be asked without profiles."""
    if profiles == NO_PROFILES:
        return
    for side in sides:
        for contract in side.package.contracts():
            yield from examine("install", Case((ready(contract),), profiles), ("resources", "permissions"))


def _outcome(impacts: Sequence[Impact], needs: Sequence[Need], findings: Iterable[Finding]) -> Outcome:
    found: list[Outcome] = [decide(findings)]
    for each in impacts:
        found += ["reject" if one.severity == "error" else "review" for one in each.errors]
    found += ["review" if each.state == "unknown" else "reject" for each in needs]
    return worst(found)
