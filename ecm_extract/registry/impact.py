"""Who breaks when a release takes the place of another one: the lines of all that is stored, without reading sources.

The changes are those of `diff`, and so is the decision on each line; only the lines that may mean a name that
changed are taken from the registry.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from typing import Final

import msgspec
from ecm_checker.finding import Certainty, Finding, Severity
from ecm_checker.hub.provision import Provision
from ecm_checker.match.consumer import Consumer
from ecm_checker.release import Change
from sqlalchemy.orm import Session

from ecm_extract.diff.break_findings import finding_of
from ecm_extract.diff.broken_names import BrokenNames
from ecm_extract.diff.consumers import uses_of
from ecm_extract.diff.model import Located, RefInfo, Verdict
from ecm_extract.diff.run import Request, located_changes, unread_between
from ecm_extract.diff.use import Use
from ecm_extract.diff.verdict import repository_verdict
from ecm_extract.extraction_model import Options
from ecm_extract.registry.doubts import Doubt, doubts_of, unread_of
from ecm_extract.registry.impact_side import Side
from ecm_extract.registry.scope import Scope
from ecm_extract.registry.users import Line, StoredConsumer, User, consumers_of
from ecm_extract.stored import Stored, stored_side
from ecm_extract.tree.unread import unread_in

SCHEMA: Final = "ecm-extract/impact/1"


class Break(msgspec.Struct, frozen=True):
    """One change that breaks somebody.

    Attributes:
        change: what changed.
        severity, certainty: of the worst line.
        message: what happens. instead: what to write.
        users: who breaks, with the lines.
        fingerprint: by which `accept` knows it.
    """

    change: Change
    severity: Severity
    certainty: Certainty
    message: str
    instead: str
    users: tuple[User, ...]
    fingerprint: str


class Impact(msgspec.Struct, frozen=True):
    """What a release breaks.

    Attributes:
        old, new: the releases. scope: who was asked, in words.
        missing: who belongs to the scope and is not stored, so that nothing is known of it.
        doubts: what was not read, and computed names that may be those that changed: none of it is known to break.
        breaks: the worst first.
        changes: all changes, `verdict` on them.
    """

    package: str
    old: str
    new: str
    scope: str
    missing: tuple[str, ...]
    doubts: tuple[Doubt, ...]
    breaks: tuple[Break, ...]
    changes: tuple[Change, ...]
    verdict: Verdict
    schema: str = SCHEMA

    @property
    def broken(self) -> tuple[str, ...]:
        """Releases that have a line that breaks."""
        found = {f"{user.package}@{user.version}" for each in self.errors for user in each.users}
        return tuple(sorted(found))

    @property
    def is_whole(self) -> bool:
        """Whether everybody was asked, and everything of them is known."""
        return not self.missing and not self.doubts

    @property
    def errors(self) -> tuple[Break, ...]:
        """What breaks somebody now: neither what is only announced nor what takes a new build."""
        return tuple(each for each in self.breaks if each.severity != "info")


def impact_of(session: Session, old: Side, new: Side, scope: Scope, beside: Sequence[Side] = ()) -> Impact:
    """Return what breaks in a scope when one release takes the place of another.

    Args:
        session: one that reads.
        old: a release of a package.
        new: another one of it.
        scope: the releases that are asked.
        beside: releases that come with the new one, and are asked in the place of those of their packages.
    """
    before, after = _stored(old), _stored(new)
    sides = stored_side(before), stored_side(after)
    request = _request(before, after)
    located = located_changes(request, *sides)
    broken = BrokenNames(located, *sides)
    consumers = [] if broken.is_empty() else consumers_of(session, broken.sought(), scope)
    replaced = {new.package.name, *(each.package.name for each in beside)}
    others = [each for each in consumers if each.package not in replaced]
    uses = [*_own(new, broken), *_uses([*others, *map(_consumer, beside)], broken)]
    changes = tuple(each.change for each in located)
    return Impact(
        package=new.package.name,
        old=old.label,
        new=new.label,
        scope=scope.shown,
        missing=scope.missing,
        doubts=(*unread_of(old, new, *beside), *doubts_of(session, _changed(located), scope, replaced)),
        breaks=tuple(_breaks(uses)),
        changes=changes,
        verdict=repository_verdict(changes, *sides, unread_between(request, *sides)),
    )


def _changed(located: Iterable[Located]) -> list[Provision]:
    """What was provided before and is not any more, or otherwise."""
    breaking = (each for entry in located if entry.change.breaking for each in entry.each)
    return [each.pair.old for each in breaking if each.pair.old is not None]


class _Used(msgspec.Struct, frozen=True):
    """A line that breaks, with the release that it is of."""

    by: StoredConsumer
    use: Use


def _stored(side: Side) -> Stored:
    return Stored(side.label, side.commit, (side.package,), unread_in(side.package.unread))


def _request(old: Stored, new: Stored) -> Request:
    infos = RefInfo(old.label, old.commit), RefInfo(new.label, new.commit)
    return Request(old=old, new=new, repo=None, name=new.label, infos=infos, options=Options(jobs=1))


def _own(new: Side, broken: BrokenNames) -> Iterator[_Used]:
    """Lines that the release itself forgot."""
    place = _consumer(new)
    yield from (_Used(place, use) for use in uses_of([place.consumer], broken, new.commit, own=True))


def _consumer(side: Side) -> StoredConsumer:
    package = side.package
    consumer = Consumer(package.name, package.requires, package.ros)
    return StoredConsumer(package.name, package.version or "", side.repository, side.commit, consumer)


def _uses(consumers: Sequence[StoredConsumer], broken: BrokenNames) -> Iterator[_Used]:
    """Lines of others; those of one commit run together, so that a remap of one counts for the others."""
    together: dict[tuple[str, str | None], list[StoredConsumer]] = defaultdict(list)
    for each in consumers:
        together[each.repository, each.commit].append(each)
    for group in together.values():
        by_package = {each.package: each for each in group}
        for use in uses_of([each.consumer for each in group], broken, group[0].commit):
            yield _Used(by_package[use.package], use)


def _breaks(used: Sequence[_Used]) -> Iterator[Break]:
    by_change: dict[object, list[_Used]] = defaultdict(list)
    for each in used:
        by_change[each.use.located.change].append(each)
    grouped = [(group[0].use.located, group) for group in by_change.values()]
    found = [(finding_of(located, [each.use for each in group]), located, group) for located, group in grouped]
    for finding, located, group in sorted(found, key=lambda entry: _rank(entry[0])):
        yield Break(
            change=located.change,
            severity=finding.severity,
            certainty=finding.certainty,
            message=finding.message,
            instead=finding.resolution,
            users=tuple(_users(group)),
            fingerprint=finding.fingerprint,
        )


def _rank(finding: Finding) -> tuple[int, str, str]:
    return ("error", "warning", "info").index(finding.severity), finding.message, finding.fingerprint


def _users(used: Sequence[_Used]) -> Iterator[User]:
    lines: dict[str, list[Line]] = defaultdict(list)
    releases: dict[str, StoredConsumer] = {}
    for each in used:
        by, use = each.by, each.use
        releases[by.release] = by
        lines[by.release].append(Line(use.path, use.line, use.what, use.certainty))
    for name in sorted(releases):
        by = releases[name]
        told = tuple(sorted(set(lines[name]), key=lambda each: (each.path, each.line, each.what)))
        yield User(by.package, by.version, by.repository, by.commit, told, fits=False)
