"""How consumers follow a release (`ecm-extract/migration/1`): for each change that breaks them what to write instead.

Paper, section "Evolution": every major release includes a machine-readable migration specification, and adapters
where feasible.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Literal, TypeAlias

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.kinds import row_of
from ecm_checker.hub.roles import endpoint_kinds, value_kinds
from ecm_checker.match.generated import headers, python_names
from ecm_checker.release import Change

from ecm_extract.diff.formats.phrases import instead

_Key: TypeAlias = tuple[str, str, str, str, str | None, str | None]
_Name: TypeAlias = tuple[str, str, str, str | None]


class Edit(msgspec.Struct, frozen=True):
    """What a consumer in a language writes: `find` and, in its place, `write`."""

    language: str
    find: str
    write: str


class Adapter(msgspec.Struct, frozen=True):
    """What keeps the old name alive meanwhile: a remap, or a parameter that is copied.

    It stands for a name that has another one and is otherwise as it was: no remap changes a type, and no pattern is
    remapped.
    """

    kind: Literal["remap", "copy_parameter"]
    old: str
    new: str


class Step(msgspec.Struct, frozen=True):
    """One change that consumers follow.

    Attributes:
        instead: what to write, for people. edits: by language, where one name takes the place of another.
        adapter: None where nothing stands for the old name.
    """

    package: str
    kind: str
    change: str
    owner: str
    old: str | None
    new: str | None
    instead: str
    edits: tuple[Edit, ...] = ()
    adapter: Adapter | None = None
    evidence_old: Evidence | None = None
    evidence_new: Evidence | None = None

    @property
    def key(self) -> _Key:
        """What makes it the step of a change."""
        return self.package, self.kind, self.change, self.owner, self.old, self.new


class Migration(msgspec.Struct, frozen=True, kw_only=True):
    """How to come from one release to another."""

    schema: Literal["ecm-extract/migration/1"] = "ecm-extract/migration/1"
    old: str
    new: str
    steps: tuple[Step, ...]


def migration_of(old: str, new: str, changes: Sequence[Change]) -> Migration:
    """Return the migration over changes: those that break and those that are announced."""
    adapters = _adapters(changes)
    return Migration(old=old, new=new, steps=tuple(_step(each, adapters) for each in changes if _is_step(each)))


def _is_step(change: Change) -> bool:
    return change.breaking or change.change == "deprecated"


def uncovered(migration: Migration, changes: Sequence[Change]) -> Iterator[Change]:
    """Yield breaking changes of which a migration tells nothing, or for which its adapter does not stand."""
    told = {step.key: step for step in migration.steps if step.instead.strip()}
    adapters = _adapters(changes)
    for change in changes:
        wanted = _step(change, adapters)
        step = told.get(wanted.key)
        if change.breaking and (step is None or step.adapter not in (None, wanted.adapter)):
            yield change


def _step(change: Change, adapters: Mapping[_Name, Adapter]) -> Step:
    renamed = bool(change.old and change.new and change.old != change.new)
    return Step(
        package=change.package,
        kind=change.kind,
        change=change.change,
        owner=change.owner,
        old=change.old,
        new=change.new,
        instead=instead(change) or "remove it",
        edits=tuple(_edits(change.kind, change.old or "", change.new or "")) if renamed else (),
        adapter=adapters.get(_name_of(change)) if change.change == "renamed" else None,
        evidence_old=change.evidence_old,
        evidence_new=change.evidence_new,
    )


def _edits(kind: str, old: str, new: str) -> Iterator[Edit]:
    if row_of(kind).generated and old.count("/") == new.count("/") == 2:
        pairs = zip(headers(old), headers(new), strict=True)
        yield from (Edit("cpp", before, after) for before, after in pairs)
        yield Edit("python", next(python_names(old)), next(python_names(new)))
    yield from (Edit(language, old, new) for language in row_of(kind).written_in)


def _name_of(change: Change) -> _Name:
    return change.package, change.kind, change.owner, change.old


def _adapters(changes: Sequence[Change]) -> Mapping[_Name, Adapter]:
    """The adapters of names that have another one, and of which nothing else breaks."""
    others = {_name_of(each) for each in changes if each.breaking and each.change != "renamed"}
    others |= {
        (each.package, kind, each.owner, each.old)
        for each in changes
        if each.row.policy and each.breaking
        for kind in endpoint_kinds()
    }
    renamed = (each for each in changes if each.change == "renamed" and _name_of(each) not in others)
    found = ((_name_of(each), _adapter(each)) for each in renamed)
    return {name: adapter for name, adapter in found if adapter is not None}


def _adapter(change: Change) -> Adapter | None:
    old, new = change.old or "", change.new or ""
    if not old or not new or "{" in f"{old}{new}":
        return None
    if change.kind in endpoint_kinds():
        return Adapter("remap", old, new)
    return Adapter("copy_parameter", old, new) if change.kind in value_kinds() else None
