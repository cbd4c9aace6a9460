"""Who uses what: the requirements that may mean some names, found by their keys, with the files that they stand in."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Final

import msgspec
from ecm_checker.finding import Certainty
from ecm_checker.hub.kinds import uses
from ecm_checker.hub.provision import Key, Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.fit import misfit
from ecm_checker.match.names import NAMES
from ecm_checker.match.provisions import OPEN, Provisions, Sought
from ecm_checker.match.spelling import text_pattern
from sqlalchemy import select
from sqlalchemy.orm import Session

from ecm_extract.registry.groups import grouped
from ecm_extract.registry.parts import clipped, is_clipped, requirements_of
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.tables import Holds, Part, Release, RequirementKey, RequirementRow

_NAMED: Final = (RequirementRow.part_id, RequirementRow.number, RequirementRow.use, RequirementRow.name)
_KEY: Final = (RequirementKey.key, RequirementKey.use, RequirementKey.part_id, RequirementKey.number)


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


def consumers_of(session: Session, sought: Iterable[Sought], scope: Scope) -> list[StoredConsumer]:
    """Return the releases of a scope that may use names, each with the files in question only.

    Args:
        session: one that reads.
        sought: by what the names are found, as `Provisions.sought` gives it.
        scope: the releases that are asked.
    """
    numbers = _numbers(session, _wanted(sought), scope)
    held: dict[int, list[int]] = defaultdict(list)
    for group in grouped(sorted(numbers)):
        query = select(Holds.release_id, Holds.part_id).where(Holds.part_id.in_(group))
        for row in session.execute(query.where(Holds.release_id.in_(scope.query()))):
            held[row.release_id].append(row.part_id)
    needed = requirements_by_part(session, {part for of in held.values() for part in of})
    return [
        _consumer(release, [_File(needed[part], numbers[part]) for part in held[release.id]])
        for release in _releases(session, held)
    ]


class _File(msgspec.Struct, frozen=True):
    """The requirements of a file, and the places of those that may mean a name in question."""

    requirements: tuple[Requirement, ...]
    numbers: set[int]


class _Place(msgspec.Struct, frozen=True):
    """A requirement: its part and its place there."""

    part: int
    number: int


class _Wanted(msgspec.Struct):
    """What is looked for by one use: keys of names, and names of which the last part is computed."""

    keys: set[str] = msgspec.field(default_factory=set)
    computed: set[str] = msgspec.field(default_factory=set)


def _wanted(sought: Iterable[Sought]) -> dict[str, _Wanted]:
    """What is looked for, by the uses that may mean it."""
    found: dict[str, _Wanted] = defaultdict(_Wanted)
    by_kind = _uses_by_kind()
    for each in sought:
        for use in by_kind.get(each.kind, ()):
            if each.key == OPEN:
                found[use].computed.add(each.name)
            else:
                found[use].keys.add(clipped(each.key))
    return found


def _uses_by_kind() -> dict[str, list[str]]:
    found: dict[str, list[str]] = defaultdict(list)
    for use, row in uses().items():
        for kind in row.of:
            found[kind].append(use)
    return found


def _numbers(session: Session, wanted: Mapping[str, _Wanted], scope: Scope) -> dict[int, set[int]]:
    """Places of requirements in their parts, by part."""
    found: dict[int, set[int]] = defaultdict(set)
    for place in chain(_keyed(session, wanted), _computed(session, wanted, scope)):
        found[place.part].add(place.number)
    return found


def _keyed(session: Session, wanted: Mapping[str, _Wanted]) -> Iterator[_Place]:
    """Requirements that have a key which is looked for."""
    for group in grouped(sorted({key for each in wanted.values() for key in each.keys})):
        for row in session.execute(select(*_KEY).where(RequirementKey.key.in_(group))):
            if row.use in wanted and row.key in wanted[row.use].keys:
                yield _Place(row.part_id, row.number)


def _computed(session: Session, wanted: Mapping[str, _Wanted], scope: Scope) -> Iterator[_Place]:
    """Requirements of a scope that may mean a name of which the last part is computed."""
    texts = {use: _text_of(use, each.computed) for use, each in wanted.items() if each.computed}
    if not texts:
        return
    here = select(Holds.part_id).where(Holds.release_id.in_(scope.query()))
    rows = select(*_NAMED).where(RequirementRow.use.in_(texts), RequirementRow.part_id.in_(here))
    for row in session.execute(rows):
        text = texts[row.use]
        if text is None or is_clipped(row.name) or text.search(row.name):
            yield _Place(row.part_id, row.number)


def _text_of(use: str, names: set[str]) -> re.Pattern[str] | None:
    """What finds the known text of computed names in a requirement; None where it need not stand there."""
    return text_pattern(sorted(names)) if NAMES[uses()[use].names].whole else None


def requirements_by_part(session: Session, parts: set[int]) -> dict[int, tuple[Requirement, ...]]:
    """Return all requirements of parts, in their order."""
    found: dict[int, tuple[Requirement, ...]] = {}
    for group in grouped(sorted(parts)):
        rows = session.execute(select(Part.id, Part.data).where(Part.id.in_(group)))
        found |= {row.id: requirements_of(row.data) for row in rows}
    return found


def _releases(session: Session, ids: Iterable[int]) -> list[Release]:
    found: list[Release] = []
    for group in grouped(sorted(ids)):
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
    found: dict[Key, list[User]] = defaultdict(list)
    for stored in consumers_of(session, asked.sought(), scope):
        for name, users in _used_by(stored, asked).items():
            found[name] += users
    return [
        UsedName(each.kind, each.owner, each.name, each.path, each.line, tuple(found[each.key]))
        for each in names
        if each.key in found
    ]


def _used_by(stored: StoredConsumer, asked: Provisions) -> dict[Key, list[User]]:
    lines: dict[tuple[Key, bool], list[Line]] = defaultdict(list)
    for entry in stored.found:
        for provision in asked.named(entry, stored.consumer):
            if not _is_own(entry, stored, provision):
                lines[provision.key, misfit(entry, provision) is None] += _lines(entry)
    found: dict[Key, list[User]] = defaultdict(list)
    for (name, fits), told in lines.items():
        place = (stored.package, stored.version, stored.repository, stored.commit)
        found[name].append(User(*place, tuple(dict.fromkeys(told)), fits))
    return found


def _is_own(entry: Requirement, stored: StoredConsumer, provision: Provision) -> bool:
    """Whether a package is built together with what it uses of itself."""
    return uses()[entry.use].built and stored.package == provision.package


def _lines(entry: Requirement) -> Iterator[Line]:
    for at in entry.evidence:
        yield Line(at.path, at.line, entry.phrase, entry.needs)
