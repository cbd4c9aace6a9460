"""How consumers follow a release (`ecm-extract/migration/1`): for each change that breaks them what to write instead.

Paper, section "Evolution": every major release includes a machine-readable migration specification, and adapters
where feasible.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final, Literal

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.match.generated import headers, python_names
from ecm_checker.release import Change

from ecm_extract.diff.formats.phrases import instead

_ENDPOINTS: Final = frozenset({"topic", "service", "action"})
_SAME: Final[Mapping[str, tuple[str, ...]]] = {
    "topic": ("cpp", "python", "launch", "yaml"),
    "service": ("cpp", "python", "launch", "yaml"),
    "action": ("cpp", "python", "launch", "yaml"),
    "parameter": ("yaml", "launch", "cpp", "python"),
    "message_field": ("cpp", "python"),
    "constant": ("cpp", "python"),
    "method": ("cpp", "python"),
    "function": ("cpp", "python"),
    "class": ("cpp", "python"),
    "member": ("cpp",),
    "plugin": ("yaml", "xml", "launch"),
    "executable": ("launch",),
    "launch_file": ("launch",),
    "launch_argument": ("launch",),
    "frame": ("yaml", "xml", "cpp", "python"),
    "package": ("package.xml", "cmake", "launch", "python"),
    "bt_node": ("xml",),
    "bt_port": ("xml",),
}
"""Languages in which consumers write a name as it is."""


class Edit(msgspec.Struct, frozen=True):
    """What a consumer in a language writes: `find` and, in its place, `write`."""

    language: str
    find: str
    write: str


class Adapter(msgspec.Struct, frozen=True):
    """What keeps the old name alive meanwhile: a remap, or a parameter that is copied."""

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
    def key(self) -> tuple[str, str, str, str | None, str | None]:
        """What makes it the step of a change."""
        return self.package, self.kind, self.owner, self.old, self.new


class Migration(msgspec.Struct, frozen=True, kw_only=True):
    """How to come from one release to another."""

    schema: Literal["ecm-extract/migration/1"] = "ecm-extract/migration/1"
    old: str
    new: str
    steps: tuple[Step, ...]


def migration_of(old: str, new: str, changes: Sequence[Change]) -> Migration:
    """Return the migration over changes: those that break and those that are announced."""
    return Migration(old=old, new=new, steps=tuple(map(_step, filter(_is_step, changes))))


def _is_step(change: Change) -> bool:
    return change.breaking or change.change == "deprecated"


def uncovered(migration: Migration, changes: Sequence[Change]) -> Iterator[Change]:
    """Yield breaking changes of which a migration tells nothing."""
    told = {step.key for step in migration.steps if step.instead}
    for change in changes:
        if change.breaking and _step(change).key not in told:
            yield change


def _step(change: Change) -> Step:
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
        adapter=_adapter(change) if renamed else None,
        evidence_old=change.evidence_old,
        evidence_new=change.evidence_new,
    )


def _edits(kind: str, old: str, new: str) -> Iterator[Edit]:
    if kind == "message" and old.count("/") == new.count("/") == 2:
        pairs = zip(headers(old), headers(new), strict=True)
        yield from (Edit("cpp", before, after) for before, after in pairs)
        yield Edit("python", next(python_names(old)), next(python_names(new)))
    yield from (Edit(language, old, new) for language in _SAME.get(kind, ()))


def _adapter(change: Change) -> Adapter | None:
    old, new = change.old or "", change.new or ""
    if change.kind in _ENDPOINTS:
        return Adapter("remap", old, new)
    return Adapter("copy_parameter", old, new) if change.kind == "parameter" else None
