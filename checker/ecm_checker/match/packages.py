"""The packages of a question, as providers and as consumers of each other."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from types import MappingProxyType
from typing import Final

import msgspec

from ecm_checker.hub.condition import all_hold
from ecm_checker.hub.kinds import kinds, kinds_that
from ecm_checker.hub.package import Package, folders_of, provisions
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import ONE_VALUE, Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.engine import Match, is_open, match
from ecm_checker.match.generated import headers, interface_package, python_names
from ecm_checker.match.launch_reach import LaunchReach
from ecm_checker.match.provisions import Provisions

_SCRIPT: Final = ".py"
_HANDS: Final = "hands_argument"
_ROS_2: Final = 2


class Unmet(msgspec.Struct, frozen=True):
    """A requirement that is not met.

    Attributes:
        consumer: whose it is.
        before: what met it; empty where nothing is known.
        hidden: whether it may be met by what could not be read.
    """

    consumer: str
    match: Match
    before: tuple[Provision, ...] = ()
    hidden: bool = False

    @property
    def requirement(self) -> Requirement:
        """What is required."""
        return self.match.requirement


class Packages:
    """What some packages provide and require together.

    Args:
        packages: their documents.
        given: launch arguments by name; what they decide against is neither provided nor required.

    Attributes:
        names: of the packages, all of whose provisions are here: nothing of them is left unread.
    """

    def __init__(self, packages: Sequence[Package], given: Mapping[str, str] = MappingProxyType({})) -> None:
        self._packages = tuple(packages)
        self._given = given
        self._partly = frozenset(package.name for package in packages if package.gaps)
        self.names = frozenset(package.name for package in packages) - self._partly
        self._possible: dict[str, frozenset[tuple[str, str]]] = {}

    @cached_property
    def provisions(self) -> Provisions:
        """All that they provide."""
        every = (each for package in self._packages for each in provisions(package.name, package).values())
        entities = [each for each in every if not each.when or all_hold(each.when, self._given) is not False]
        return Provisions(entities, frozenset(name for package in self._packages for name in package.bound))

    @cached_property
    def consumers(self) -> Sequence[Consumer]:
        """Each of them as a consumer."""
        return [Consumer(package.name, self._required(package), package.ros) for package in self._packages]

    def _required(self, package: Package) -> Sequence[Requirement]:
        if not self._given:
            return package.requires
        return [each for each in package.requires if all_hold(each.when, self._given) is not False]

    def version(self, name: str) -> str | None:
        """Return the version of a package; None where it is not here, or declares none."""
        return next((each.version for each in self._packages if each.name == name), None)

    @cached_property
    def by_name(self) -> Mapping[str, Package]:
        """The packages by name."""
        return {package.name: package for package in self._packages}

    def match(self, requirement: Requirement, consumer: Consumer) -> Match:
        """Match a requirement; what its package may have without telling is not known to be missing."""
        found = match(requirement, consumer, self.provisions, self.names)
        if found.state == "dangling" and self._may_be(requirement):
            return Match(requirement, "unknown")
        return found

    @cached_property
    def _reach(self) -> LaunchReach:
        return LaunchReach(self._packages)

    def _may_be(self, requirement: Requirement) -> bool:
        if requirement.use == _HANDS and requirement.ros == _ROS_2 and self._reach.may_read(requirement):
            return True
        home = requirement.package or interface_package(requirement.name) or ""
        package = self.by_name.get(home)
        if package is None or requirement.kind in package.open:
            return package is not None
        possible = self._possible_of(package)
        return any((requirement.kind, name) in possible for name in _spellings(requirement))

    def _possible_of(self, package: Package) -> frozenset[tuple[str, str]]:
        """Kind and name of what the build of a package may make, as requirements name it."""
        if package.name not in self._possible:
            rows = _possible(package)
            self._possible[package.name] = frozenset((kind, name) for kind, names in rows for name in names)
        return self._possible[package.name]

    def may_hide(self, lost: Iterable[Provision]) -> bool:
        """Whether what an earlier release provided may be in what could not be read of these packages."""
        return any(each.package in self._partly or self._is_open(each) for each in lost)

    def _is_open(self, lost: Provision) -> bool:
        """Whether its owner may have it under a name that is not told: a node has only parameters so."""
        owners = self.provisions.owners(lost.package, lost.owner) if lost.owner else ()
        return any(each.open and (lost.is_value or not each.row.runs) for each in owners)

    def unmet(self) -> Iterator[Unmet]:
        """Yield what they require of each other and do not get.

        What any package of the world may provide is left out: whether it meets is decided where modules run together.
        """
        for consumer in self.consumers:
            for requirement in consumer.requirements:
                if _is_asked(requirement):
                    found = self.match(requirement, consumer)
                    if found.state in {"dangling", "incompatible"}:
                        yield Unmet(consumer.package, found)


def _possible(package: Package) -> Iterator[tuple[str, Iterable[str]]]:
    """Names by kind; a program may be any file where files are started by their names, as ROS 1 does.

    Below its share folder lies what lies in its own, or is put there.
    """
    files, programs = kinds_that(lambda row: row.included), kinds_that(lambda row: row.started)
    if package.runs_files:
        yield from ((kind, [path.rpartition("/")[2] for path in package.files]) for kind in programs)
    yield from ((kind, package.shared) for kind in files)
    for kind, names in package.possible.items():
        if not kinds()[kind].generated:
            yield kind, names
            continue
        for name in names:
            yield kind, python_names(name)
            yield from ((file, headers(name)) for file in files)


def _spellings(requirement: Requirement) -> Iterator[str]:
    """The name; that of a program may have the suffix of a script, a file may lie in a folder that may hold any."""
    yield requirement.name
    if kinds()[requirement.kind].included:
        yield from (f"{folder}/" for folder in folders_of(requirement.name))
    if kinds()[requirement.kind].started:
        yield requirement.name.removesuffix(_SCRIPT)
        yield f"{requirement.name}{_SCRIPT}"


def _is_asked(requirement: Requirement) -> bool:
    """Whether what others provide now decides: one variable takes whatever a function returns."""
    row, given = requirement.row, requirement.given
    is_tolerated = row.tolerated != 0 and requirement.ros == row.tolerated
    takes_any = given is not None and given.takes == ONE_VALUE
    return row.stated and not is_open(requirement) and not is_tolerated and not takes_any


def broken(users: Packages, before: Packages, after: Packages) -> Iterator[Unmet]:
    """Yield what users got of a release and do not get of the next one (paper, "Release Discipline").

    Of a release that was not read as a whole a name that is not found may be hidden: it is yielded, never passed over.

    Args:
        users: the packages that require.
        before: the packages of the old release.
        after: those of the new one: all that was met before must be met by them.
    """
    for consumer in users.consumers:
        for requirement in consumer.requirements:
            was = before.match(requirement, consumer)
            if was.state != "met":
                continue
            now = after.match(requirement, consumer)
            if now.state != "met" and (now.breach or "gone") in requirement.row.breaches:
                yield Unmet(consumer.package, now, was.found, after.may_hide(was.found))
