"""Who uses what: the requirements that may mean some names, found by their keys, with the files that they stand in."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from typing import Final, TypeVar

import msgspec
from ecm_checker.finding import Certainty
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.fit import misfit
from ecm_checker.match.provisions import OPEN, Provisions
from sqlalchemy import Select, select
from sqlalchemy.orm import Session

from ecm_extract.registry.parts import clipped, requirements_of
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.tables import Holds, Part, Release, RequirementKey

_AT_ONCE: Final = 500
_Item = TypeVar("_Item")


class StoredConsumer(msgspec.Struct, frozen=True):
    """A release with those of its files that may use the names in question; `found` are the lines that may."""

    package: str
    version: str
    repository: str
    commit: str | None
    consumer: Consumer
    found: tuple[Requirement, ...] = ()

    @property
    def release(self) -> str:
        """`package@version`."""
        return f"{self.package}@{self.version}"


class Line(msgspec.Struct, frozen=True):
    """A line that uses a name: `what` it does with it, in words."""

    path: str
    line: int
    what: str
    certainty: Certainty


class User(msgspec.Struct, frozen=True):
    """A release that uses a name, where it was read, and the lines; `fits` is false where they do not fit the name."""

    package: str
    version: str
    repository: str
    commit: str | None
    lines: tuple[Line, ...]
    fits: bool = True


class UsedName(msgspec.Struct, frozen=True):
    """A public name and who uses it."""

    kind: str
    owner: str
    name: str
    path: str
    line: int
    users: tuple[User, ...]


def consumers_of(session: Session, keys: Iterable[tuple[str, str]], scope: Scope) -> list[StoredConsumer]:
    """Return the releases of a scope that may use names, each with the files in question only.

    Args:
        session: one that reads.
        keys: kinds and keys of the names, as `Provisions.keys` gives them.
        scope: the releases that are asked.
    """
    numbers = _numbers(session, _wanted(keys))
    held: dict[int, list[int]] = defaultdict(list)
    for group in _groups(sorted(numbers)):
        query = select(Holds.release_id, Holds.part_id).where(Holds.part_id.in_(group))
        for row in session.execute(query.where(Holds.release_id.in_(scope.query()))):
            held[row.release_id].append(row.part_id)
    needed = _requirements(session, {part for of in held.values() for part in of})
    return [
        _consumer(release, [_File(needed[part], numbers[part]) for part in held[release.id]])
        for release in _releases(session, held)
    ]


class _File(msgspec.Struct, frozen=True):
    """The requirements of a file, and the places of those that may mean a name in question."""

    requirements: tuple[Requirement, ...]
    numbers: set[int]


def _wanted(keys: Iterable[tuple[str, str]]) -> dict[str, set[str]]:
    """The keys by the uses that may mean them; a computed name may be any."""
    found: dict[str, set[str]] = defaultdict(set)
    for kind, key in keys:
        for use, row in uses().items():
            if kind in row.of:
                found[use].add(key)
    return found


def _numbers(session: Session, wanted: dict[str, set[str]]) -> dict[int, set[int]]:
    """Places of requirements in their parts, by part."""
    found: dict[int, set[int]] = defaultdict(set)
    for use, keys in wanted.items():
        of_use = select(RequirementKey.part_id, RequirementKey.number).where(RequirementKey.use == use)
        for query in _narrowed(of_use, keys):
            for row in session.execute(query):
                found[row.part_id].add(row.number)
    return found


def _narrowed(query: Select[int, int], keys: set[str]) -> Iterator[Select[int, int]]:
    if OPEN in keys:
        yield query
        return
    for group in _groups(sorted(set(map(clipped, keys)))):
        yield query.where(RequirementKey.key.in_(group))


def _groups(items: Sequence[_Item]) -> Iterator[list[_Item]]:
    rest = iter(items)
    while group := list(islice(rest, _AT_ONCE)):
        yield group


def _requirements(session: Session, parts: set[int]) -> dict[int, tuple[Requirement, ...]]:
    found: dict[int, tuple[Requirement, ...]] = {}
    for group in _groups(sorted(parts)):
        rows = session.execute(select(Part.id, Part.data).where(Part.id.in_(group)))
        found |= {row.id: requirements_of(row.data) for row in rows}
    return found


def _releases(session: Session, ids: Iterable[int]) -> list[Release]:
    found: list[Release] = []
    for group in _groups(sorted(ids)):
        found += session.scalars(select(Release).where(Release.id.in_(group)))
    return sorted(found, key=lambda each: (each.package, each.rank))


def _consumer(release: Release, files: Sequence[_File]) -> StoredConsumer:
    consumer = Consumer(release.package, [entry for file in files for entry in file.requirements])
    found = tuple(file.requirements[number] for file in files for number in sorted(file.numbers))
    return StoredConsumer(release.package, release.version, release.repository, release.commit, consumer, found)


def used_names(session: Session, provisions: Provisions, names: Sequence[Provision], scope: Scope) -> list[UsedName]:
    """Return who uses names.

    Args:
        session: one that reads.
        provisions: all that their package provides.
        names: those of them that are asked about.
        scope: the releases that are asked.
    """
    asked = Provisions(names, whole=provisions)
    found: dict[int, list[User]] = defaultdict(list)
    for stored in consumers_of(session, asked.keys(), scope):
        for name, users in _used_by(stored, asked).items():
            found[name] += users
    return [
        UsedName(each.kind, each.owner, each.name, each.path, each.line, tuple(found[id(each)]))
        for each in names
        if id(each) in found
    ]


def _used_by(stored: StoredConsumer, asked: Provisions) -> dict[int, list[User]]:
    lines: dict[tuple[int, bool], list[Line]] = defaultdict(list)
    for entry in stored.found:
        for provision in asked.named(entry, stored.consumer):
            if not _is_own(entry, stored, provision):
                lines[id(provision), misfit(entry, provision) is None] += _lines(entry)
    found: dict[int, list[User]] = defaultdict(list)
    for (name, fits), told in lines.items():
        place = (stored.package, stored.version, stored.repository, stored.commit)
        found[name].append(User(*place, tuple(dict.fromkeys(told)), fits))
    return found


def _is_own(entry: Requirement, stored: StoredConsumer, provision: Provision) -> bool:
    """Whether a package is built together with what it uses of itself."""
    return uses()[entry.use].built and stored.package == provision.package


def _lines(entry: Requirement) -> Iterator[Line]:
    for at in entry.evidence:
        yield Line(at.path, at.line, entry.phrase, entry.certainty)
