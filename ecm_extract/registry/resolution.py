"""Resolution: one release of each requested package and of what it depends on, or the reason why there is none.

Versions decide first; then what is chosen is checked like `check` does (may each be installed, do those that need
each other fit, do all run together), and what is refused is told to the search, until an answer stands.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final, Literal

import msgspec
from ecm_checker.case import Case
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from ecm_checker.match.generated import interface_package
from ecm_checker.match.packages import Packages, Unmet
from ecm_checker.operations.engine import examine, ready
from ecm_checker.operations.system import system
from ecm_checker.profiles import NO_PROFILES, Profiles
from ecm_checker.versions import in_range
from packaging.specifiers import InvalidSpecifier, SpecifierSet
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.errors import InputError
from ecm_extract.registry.channels import channels_from
from ecm_extract.registry.choice import Fact, NoAnswerError, Option, Place, Problem, choose
from ecm_extract.registry.releases import name_of, package_of_release
from ecm_extract.registry.tables import Dependency, Release, Standing

_COMPARES: Final = "<>=!~"


class Wish(msgspec.Struct, frozen=True):
    """A requested package and the range of its versions; `*` for any."""

    package: str
    wanted: str = "*"


class Locked(msgspec.Struct, frozen=True):
    """A release that was chosen, by the hash of its contract; `by` names who asked for it."""

    package: str
    version: str
    contract: str
    repository: str
    tag: str | None
    commit: str | None
    channel: str | None
    by: tuple[str, ...]


class Outside(msgspec.Struct, frozen=True):
    """A dependency that the registry does not have; `known` when the runtime profile has a version in its range."""

    package: str
    wanted: str
    by: str
    known: bool


class Passed(msgspec.Struct, frozen=True):
    """A better release that was not chosen, and why."""

    release: str
    reason: str


class Lock(msgspec.Struct, frozen=True, kw_only=True):
    """One release of each package: what to install."""

    schema: Literal["ecm-extract/lock/1"] = "ecm-extract/lock/1"
    requests: tuple[Wish, ...]
    releases: tuple[Locked, ...]
    outside: tuple[Outside, ...]
    passed: tuple[Passed, ...]
    findings: tuple[Finding, ...]


class NoResolutionError(InputError):
    """Nothing fits; the message says why in words, `reasons` one by one."""

    def __init__(self, reasons: Sequence[str]) -> None:
        super().__init__(f"nothing fits: {'; '.join(reasons)}", "loosen one of these")
        self.reasons = tuple(reasons)


def wish_of(text: str) -> Wish:
    """Read `package`, `package@1.2.0`, or `package>=1.2,<2`.

    Raises:
        InputError: the range cannot be read.
    """
    at = next((place for place, char in enumerate(text) if char in f"@{_COMPARES}"), len(text))
    package, rest = text[:at].strip(), text[at:]
    wanted = f"=={rest[1:]}" if rest.startswith("@") else rest or "*"
    try:
        SpecifierSet("" if wanted == "*" else wanted)
    except InvalidSpecifier as error:
        message = f"{text}: {wanted} is no range of versions"
        raise InputError(message, "write PACKAGE, PACKAGE@1.2.0, or 'PACKAGE>=1.2,<2'") from error
    return Wish(package, wanted)


def resolve(
    session: Session, wishes: Sequence[Wish], profiles: Profiles = NO_PROFILES, channel: str | None = None
) -> Lock:
    """Choose releases.

    Args:
        session: one that reads.
        wishes: what is requested.
        profiles: of the robot, its governance and what is installed.
        channel: the lowest that may be chosen; None for any.

    Raises:
        NoResolutionError: nothing fits.
        InputError: a requested package is not stored, or there is no such channel.
    """
    return _Resolution(session, wishes, profiles, _channels(profiles, channel)).run()


def _is_clash(unmet: Unmet, user: Place, provider: Place) -> bool:
    wanted = unmet.requirement
    home = wanted.package or interface_package(wanted.name)
    return unmet.consumer == user.family and home == provider.family and wanted.certainty == "proved"


def _channels(profiles: Profiles, channel: str | None) -> frozenset[str] | None:
    """The channels that may be chosen: from one upwards, and those that the policy lets run."""
    allowed = profiles.policy.release_channels if profiles.policy is not None else None
    above = channels_from(channel) if channel is not None else None
    if allowed is None or above is None:
        found = allowed if allowed is not None else above
        return frozenset(found) if found is not None else None
    return frozenset(above) & frozenset(allowed)


class _Resolution:
    """One run: the releases in question, and what was found out about them."""

    def __init__(
        self, session: Session, wishes: Sequence[Wish], profiles: Profiles, channels: frozenset[str] | None
    ) -> None:
        self._session, self._wishes, self._profiles, self._channels = session, wishes, profiles, channels
        self._releases: dict[str, list[tuple[Release, Standing]]] = {}
        self._needs: dict[int, dict[str, str]] = {}
        self._packages: dict[Place, Package] = {}
        self._excluded: dict[Place, str] = {}
        self._clashes: dict[tuple[Place, Place], str] = {}
        self._checked: set[tuple[Place, ...]] = set()

    def run(self) -> Lock:
        """Choose, check, and choose again until nothing more is refused."""
        self._load()
        while True:
            problem = self._problem()
            try:
                chosen = choose(problem)
            except NoAnswerError as error:
                raise NoResolutionError([*self._said(error.facts, problem)]) from None
            refused = len(self._excluded) + len(self._clashes)
            self._check(chosen)
            if refused == len(self._excluded) + len(self._clashes):
                return self._lock(chosen, problem)

    def _load(self) -> None:
        waiting = [wish.package for wish in self._wishes]
        for package in waiting:
            if not self._found(package):
                message = f"{package} is not in the registry"
                raise InputError(message, "`ecm-extract registry list` tells what is")
        while waiting:
            package = waiting.pop()
            for release, _ in self._releases[package]:
                rows = self._session.scalars(select(Dependency).filter_by(release_id=release.id))
                self._needs[release.id] = {row.package: row.wanted for row in rows}
                waiting += [
                    name for name in self._needs[release.id] if name not in self._releases and self._found(name)
                ]

    def _found(self, package: str) -> bool:
        """Whether the registry has a package; its releases, the best first: not deprecated, then the newest."""
        if package not in self._releases:
            query = select(Release, Standing).join(Standing, Standing.release_id == Release.id)
            query = query.where(Release.package == package, Standing.withdrawn.is_(None)).order_by(Release.rank.desc())
            rows = [(release, standing) for release, standing in self._session.execute(query)]
            if not rows:
                return False
            self._releases[package] = sorted(rows, key=lambda row: row[1].deprecated is not None)
            for number, (_, standing) in enumerate(self._releases[package]):
                if self._channels is not None and standing.channel not in self._channels:
                    self._excluded[Place(package, number)] = f"it is in {standing.channel}"
        return True

    def _problem(self) -> Problem:
        families = {
            package: [Option(release.version, self._places(release)) for release, _ in rows]
            for package, rows in sorted(self._releases.items())
        }
        requests: dict[str, frozenset[int]] = {}
        for wish in self._wishes:
            places = self._in_range(wish.package, wish.wanted)
            requests[wish.package] = requests.get(wish.package, places) & places
        return Problem(families, requests, frozenset(self._excluded), frozenset(self._clashes))

    def _places(self, release: Release) -> Mapping[str, frozenset[int]]:
        needs = self._needs[release.id]
        return {name: self._in_range(name, wanted) for name, wanted in needs.items() if name in self._releases}

    def _in_range(self, package: str, wanted: str) -> frozenset[int]:
        """Places whose version is in a range; one that cannot be read is not refused for it."""
        rows = enumerate(self._releases[package])
        return frozenset(number for number, (release, _) in rows if in_range(release.version, wanted) is not False)

    def _check(self, chosen: Mapping[str, int]) -> None:
        """Find out what of a choice is refused."""
        places = [Place(*item) for item in chosen.items()]
        for place in places:
            self._check_alone(place)
        for place in places:
            for name in self._needs[self._release(place).id]:
                if name in chosen:
                    self._check_pair(place, Place(name, chosen[name]))
        asked = [each for each in places if each.family in {wish.package for wish in self._wishes}]
        for number, one in enumerate(asked):
            for other in asked[number + 1 :]:
                self._check_together(one, other)

    def _once(self, *places: Place) -> bool:
        new = places not in self._checked
        self._checked.add(places)
        return new

    def _check_alone(self, place: Place) -> None:
        """InstallCompat: what the robot lacks, what governance forbids, what is installed in another version."""
        if not self._once(place):
            return
        contracts = self._package(place).contracts()
        found = [
            each
            for contract in contracts
            for each in examine("install", Case((ready(contract),), self._profiles), ("resources", "permissions"))
        ]
        wrong = [each.message for each in found if each.severity == "error"]
        wrong += [f"{name} {version} is installed" for name, version in self._mismatched(place)]
        if wrong:
            self._excluded[place] = wrong[0]

    def _mismatched(self, place: Place) -> Iterator[tuple[str, str]]:
        installed = self._profiles.runtime.versions if self._profiles.runtime is not None else {}
        for name, wanted in self._needs[self._release(place).id].items():
            if name in installed and name not in self._releases and in_range(installed[name], wanted) is False:
                yield name, installed[name]

    def _check_pair(self, user: Place, provider: Place) -> None:
        """Whether what a release depends on provides the names that it needs."""
        if not self._once(user, provider):
            return
        given = msgspec.structs.replace(self._package(provider), requires=())
        unmet = Packages([given, self._package(user)]).unmet()
        wanted = next((each.requirement for each in unmet if _is_clash(each, user, provider)), None)
        if wanted is not None:
            at = wanted.evidence[0]
            self._clashes[user, provider] = f"{at.path}:{at.line} {wanted.phrase}, which is not there"

    def _check_together(self, one: Place, other: Place) -> None:
        """Whether two requested packages run together."""
        if not self._once(one, other):
            return
        for finding in self._found_together(one, other):
            if finding.severity == "error" and _spans(finding, one.family, other.family):
                self._clashes[one, other] = finding.message
                return

    def _found_together(self, one: Place, other: Place) -> Sequence[Finding]:
        contracts = [*self._package(one).contracts(), *self._package(other).contracts()]
        return system(contracts, self._profiles, together=True).findings

    def _release(self, place: Place) -> Release:
        return self._releases[place.family][place.number][0]

    def _package(self, place: Place) -> Package:
        if place not in self._packages:
            self._packages[place] = package_of_release(self._session, self._release(place))
        return self._packages[place]

    def _lock(self, chosen: Mapping[str, int], problem: Problem) -> Lock:
        places = [Place(*item) for item in sorted(chosen.items())]
        contracts = [each for place in places for each in self._package(place).contracts()]
        together = system(contracts, self._profiles, together=False) if contracts else None
        return Lock(
            requests=tuple(self._wishes),
            releases=tuple(self._locked(place, chosen) for place in places),
            outside=tuple(dict.fromkeys(each for place in places for each in self._outside(place))),
            passed=tuple(each for place in places for each in self._passed(place, chosen, problem)),
            findings=together.findings if together is not None else (),
        )

    def _locked(self, place: Place, chosen: Mapping[str, int]) -> Locked:
        release, standing = self._releases[place.family][place.number]
        asked = ["request"] if any(wish.package == place.family for wish in self._wishes) else []
        users = [self._release(Place(*item)) for item in sorted(chosen.items())]
        by = [name_of(each) for each in users if place.family in self._needs[each.id]]
        where = (release.repository, release.tag, release.commit, standing.channel)
        return Locked(place.family, release.version, f"sha256:{release.digest}", *where, (*asked, *by))

    def _outside(self, place: Place) -> Iterator[Outside]:
        installed = self._profiles.runtime.versions if self._profiles.runtime is not None else {}
        release = self._release(place)
        for name, wanted in sorted(self._needs[release.id].items()):
            if name not in self._releases:
                known = name in installed and in_range(installed[name], wanted) is True
                yield Outside(name, wanted, name_of(release), known)

    def _passed(self, place: Place, chosen: Mapping[str, int], problem: Problem) -> Iterator[Passed]:
        for number in range(place.number):
            better = Place(place.family, number)
            yield Passed(name_of(self._release(better)), self._why_not(better, chosen, problem))

    def _why_not(self, place: Place, chosen: Mapping[str, int], problem: Problem) -> str:
        if place in self._excluded:
            return self._excluded[place]
        for pair, why in sorted(self._clashes.items()):
            if place in pair:
                other = pair[0] if pair[1] == place else pair[1]
                return f"not with {name_of(self._release(other))}: {why}"
        for wish in self._wishes:
            if wish.package == place.family and place.number not in problem.requests[place.family]:
                return f"{wish.wanted} is requested"
        for name, number in sorted(chosen.items()):
            user = self._release(Place(name, number))
            if place.number not in problem.families[name][number].needs.get(place.family, {place.number}):
                return f"{name_of(user)} needs {self._needs[user.id][place.family]}"
        return "there is no answer with it"

    def _said(self, facts: Sequence[Fact], problem: Problem) -> Iterator[str]:
        """A conflict in words: each fact, then why releases of its families are left out."""
        for fact in facts:
            yield self._fact(fact, problem)
        families = dict.fromkeys(name for fact in facts for name in (fact.family, fact.needs) if name)
        for place, why in sorted(self._excluded.items()):
            if place.family in families:
                yield f"{name_of(self._release(place))} is left out: {why}"

    def _fact(self, fact: Fact, problem: Problem) -> str:
        if fact.clash:
            pairs = {(one.family, other.family): why for (one, other), why in sorted(self._clashes.items())}
            why = pairs.get((fact.family, fact.needs)) or pairs.get((fact.needs, fact.family), "")
            return f"{fact.family} and {fact.needs} do not go together: {why}"
        if not fact.needs:
            wanted = [wish.wanted for wish in self._wishes if wish.package == fact.family]
            ranges = "".join(f" {each}" for each in wanted if each != "*")
            return f"{fact.family}{ranges} is requested"
        needed = {self._needs[release.id].get(fact.needs) for release, _ in self._releases[fact.family]}
        return f"{fact.family} needs {fact.needs} {' or '.join(sorted(filter(None, needed)))}"


def _spans(finding: Finding, one: str, other: str) -> bool:
    """Whether a finding is between modules of two packages."""
    packages = {subject.split(".")[1] for subject in finding.subjects if subject.count(".") >= 1}
    return {one, other} <= packages
