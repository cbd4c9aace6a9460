"""Which requirements of consumers were met before a change and are not after it (paper, "Release Discipline")."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import msgspec
from ecm_checker.finding import Certainty
from ecm_checker.hub.provision import Provision
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.consumer import Consumer
from ecm_checker.match.names import is_of_program

from ecm_extract.diff.breach import breach
from ecm_extract.diff.broken_names import GONE, BrokenNames
from ecm_extract.diff.model import Located
from ecm_extract.diff.remaps import Remaps
from ecm_extract.diff.use import Use

_Mark = tuple[str, str | None, str, int]
"""Use, name, path and line: one line is told once for a name that changed."""


class _Break(msgspec.Struct, frozen=True):
    """A change that breaks a requirement: how surely, and what the line does, as a phrase."""

    located: Located
    certainty: Certainty
    what: str


class _Question(msgspec.Struct, frozen=True):
    """What is asked of all consumers: see `uses_of`."""

    broken: BrokenNames
    remaps: Remaps
    commit: str | None
    own: bool


def uses_of(consumers: Sequence[Consumer], broken: BrokenNames, commit: str | None, own: bool = False) -> Iterator[Use]:
    """Yield the lines of consumers that changes break, each once for a change.

    Args:
        consumers: packages of one tree or document.
        broken: the changes.
        commit: that the consumers were read at.
        own: whether they are the new side itself, which builds: only names that are gone count there.
    """
    if broken.is_empty():
        return
    question = _Question(broken, Remaps(consumers), commit, own)
    seen: set[_Mark] = set()
    for consumer in consumers:
        if broken.is_of_other_ros(consumer):
            continue
        for requirement in consumer.requirements:
            for use in _uses(requirement, consumer, question):
                mark = _mark(use)
                if mark not in seen:
                    seen.add(mark)
                    yield use


def _uses(requirement: Requirement, consumer: Consumer, question: _Question) -> Iterator[Use]:
    for found in _breaks(requirement, consumer, question.broken):
        if _is_answered(requirement, found) or question.remaps.lead_elsewhere(requirement, consumer.package):
            continue
        if question.own and not _is_forgotten(requirement, found.located, question.broken):
            continue
        alive = question.remaps.keep_alive(found.located)
        for at in requirement.evidence:
            yield Use(
                located=found.located,
                package=consumer.package,
                requirement=requirement,
                at=at,
                commit=question.commit,
                what=found.what,
                certainty=found.certainty,
                remapped=alive,
            )


def _mark(use: Use) -> _Mark:
    change = use.located.change
    return use.requirement.use, change.old or change.new, use.path, use.line


def _breaks(requirement: Requirement, consumer: Consumer, broken: BrokenNames) -> Iterator[_Break]:
    if requirement.certainty == "unknown":
        return
    row = requirement.row
    if "layout" in row.breaches:
        located = broken.layout_of(requirement.name)
        if located is not None:
            yield _Break(located, requirement.needs, requirement.phrase)
        return
    for located in broken.meant(requirement, consumer):
        old = located.pair.old
        if old is None or (row.built and old.package == consumer.package):
            continue
        certainty = breach(requirement, consumer, located, broken)
        if certainty is not None:
            yield _told(requirement, located, old, certainty)
    if "duty" in row.breaches:
        yield from _duties(requirement, broken)


def _told(requirement: Requirement, located: Located, old: Provision, certainty: Certainty) -> _Break:
    """How surely a line breaks, and what it does; a remap of the changed program itself names the changed name."""
    if old.row.released and requirement.kind != old.kind:
        # what went with a whole package may have gone to another repository
        return _Break(located, "likely", requirement.phrase)
    if requirement.row.leads and is_of_program(requirement, old.package):
        return _Break(located, "proved", f"remaps {requirement.name}")
    return _Break(located, certainty, requirement.phrase)


def _duties(requirement: Requirement, broken: BrokenNames) -> Iterator[_Break]:
    given = requirement.given
    for located in broken.duties_of(requirement.package, requirement.name):
        new = located.pair.new
        if new is not None and (given is None or new.name not in given.names):
            forwarded = given is not None and given.forwarded
            what = f"includes {requirement.name} without {new.name}"
            yield _Break(located, "likely" if forwarded else "proved", what)


def _is_forgotten(requirement: Requirement, located: Located, broken: BrokenNames) -> bool:
    """Whether a line of the new side can be one that the release forgot.

    Its C++ was built with the change; a publisher that lost its listener in the same release is no accident; a package
    that it depends on and no longer has is taken from elsewhere; where only a part of a name tells, a file that came
    with it means what is there now.
    """
    entity, change = located.pair.old, located.change
    if entity is not None and entity.is_computed and not any(broken.is_older(at.path) for at in requirement.evidence):
        return False
    if requirement.row.brings and change.change == "removed":
        return False
    if change.row.duty:
        return True
    if entity is None or change.change == "deprecated" or requirement.row.built:
        return False
    if entity.facet == "subscribed":
        return False
    return change.change in GONE or not (entity.row.wire and entity.row.part)


def _is_answered(requirement: Requirement, found: _Break) -> bool:
    """Whether a comment on the line says that the break is known."""
    change = found.located.change
    names = change.old or "", change.new or "", requirement.name, requirement.owner
    return any(word in name for word in requirement.ignored for name in names)
