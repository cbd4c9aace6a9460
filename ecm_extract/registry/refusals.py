"""What of a choice is refused: as `check` decides whether releases may be installed, fit, and run together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import msgspec
from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.match.generated import interface_package
from ecm_checker.match.packages import Packages, Unmet
from ecm_checker.operations.engine import examine, ready
from ecm_checker.operations.system import system
from ecm_checker.profiles import Profiles
from ecm_checker.versions import in_range

from ecm_extract.registry.pool import Pool
from ecm_extract.registry.problem import Place


class Refusals:
    """What was found out about the releases of a pool; each question is asked once.

    Attributes:
        excluded: places that may not be chosen, and why. clashes: pairs that may not stand together, and why.
    """

    def __init__(self, pool: Pool, profiles: Profiles, channels: frozenset[str] | None) -> None:
        self._pool, self._profiles = pool, profiles
        self.excluded: dict[Place, str] = dict(_in_other_channels(pool, channels))
        self.clashes: dict[tuple[Place, Place], str] = {}
        self._checked: set[tuple[Place, ...]] = set()

    def check(self, chosen: Mapping[str, int]) -> bool:
        """Find out what of a choice is refused, and return whether something new is."""
        before = len(self.excluded) + len(self.clashes)
        places = [Place(*item) for item in chosen.items()]
        for place in places:
            self._check_alone(place)
        for place in places:
            for name in self._pool.needs_of(place):
                if name in chosen:
                    self._check_pair(place, Place(name, chosen[name]))
        asked = [each for each in places if each.family in {wish.package for wish in self._pool.wishes}]
        for number, one in enumerate(asked):
            for other in asked[number + 1 :]:
                self._check_together(one, other)
        return len(self.excluded) + len(self.clashes) > before

    def _once(self, *places: Place) -> bool:
        new = places not in self._checked
        self._checked.add(places)
        return new

    def _check_alone(self, place: Place) -> None:
        """InstallCompat: what the robot lacks, what governance forbids, what is installed in another version."""
        if not self._once(place):
            return
        contracts = self._pool.package(place).contracts()
        found = [
            each
            for contract in contracts
            for each in examine("install", Case((ready(contract),), self._profiles), ("resources", "permissions"))
        ]
        wrong = [each.message for each in found if each.severity == "error"]
        wrong += [f"{name} {version} is installed" for name, version in self._mismatched(place)]
        if wrong:
            self.excluded[place] = wrong[0]

    def _mismatched(self, place: Place) -> Iterator[tuple[str, str]]:
        installed = self._profiles.runtime.versions if self._profiles.runtime is not None else {}
        for name, wanted in self._pool.needs_of(place).items():
            if name in installed and name not in self._pool.releases and in_range(installed[name], wanted) is False:
                yield name, installed[name]

    def _check_pair(self, user: Place, provider: Place) -> None:
        """Whether what a release depends on provides the names that it needs."""
        if not self._once(user, provider):
            return
        given = msgspec.structs.replace(self._pool.package(provider), requires=())
        unmet = Packages([given, self._pool.package(user)]).unmet()
        wanted = next((each.requirement for each in unmet if _is_clash(each, user, provider)), None)
        if wanted is not None:
            at = wanted.evidence[0]
            self.clashes[user, provider] = f"{at.path}:{at.line} {wanted.phrase}, which is not there"

    def _check_together(self, one: Place, other: Place) -> None:
        """Whether two requested packages run together."""
        if not self._once(one, other):
            return
        for finding in self._found_together(one, other):
            if finding.severity == "error" and _spans(finding, one.family, other.family):
                self.clashes[one, other] = finding.message
                return

    def _found_together(self, one: Place, other: Place) -> Sequence[Finding]:
        contracts = [*self._pool.package(one).contracts(), *self._pool.package(other).contracts()]
        return system(contracts, self._profiles, together=True).findings


def _in_other_channels(pool: Pool, channels: frozenset[str] | None) -> Iterator[tuple[Place, str]]:
    for package, rows in pool.releases.items():
        for number, (_, standing) in enumerate(rows):
            if channels is not None and standing.channel not in channels:
                yield Place(package, number), f"it is in {standing.channel}"


def _is_clash(unmet: Unmet, user: Place, provider: Place) -> bool:
    wanted = unmet.requirement
    home = wanted.package or interface_package(wanted.name)
    return unmet.consumer == user.family and home == provider.family and wanted.certainty == "proved"


def _spans(finding: Finding, one: str, other: str) -> bool:
    """Whether a finding is between modules of two packages."""
    packages = {subject.split(".")[1] for subject in finding.subjects if subject.count(".") >= 1}
    return {one, other} <= packages
