"""What a migration guide or changelog says that a release changed, as written in diff_recall/*.yaml."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import msgspec
from comparisons import Change

_FOUND_BY = {
    "removed": {"removed"},
    "renamed": {"renamed", "moved", "deprecated"},
    "moved": {"moved", "renamed"},
    "replaced": {"removed", "renamed", "moved", "deprecated"},
    "added": {"added"},
    "type_changed": {"type_changed"},
    "default_changed": {"default_changed"},
    "signature_changed": {"signature_changed"},
    "deprecated": {"deprecated"},
}
_PLACE = re.compile(r"^[^:]+: ")
_HOLE = re.compile(r"<[^<>]*>")


class Row(msgspec.Struct, frozen=True, forbid_unknown_fields=True, omit_defaults=True):
    """One documented change.

    Attributes:
        kind: of DESIGN §6.
        change: its word there, or `replaced`: the old name is gone or going and another does its work.
        line: of the guide.
        old, new: the names; `<...>` stands for what the document leaves open. An addition has no old name.
        package, owner: only changes of these count; the owner is a part of its name. Empty for any.
        absent: why the sources at the two refs contradict the document; such a row is not asked for.
    """

    kind: str
    change: str
    line: int
    old: str = ""
    new: str = ""
    package: str = ""
    owner: str = ""
    absent: str = ""

    @property
    def text(self) -> str:
        """The row in one line."""
        names = " -> ".join(name for name in (self.old, self.new) if name)
        return f"{self.kind} {self.change} {self.owner or self.package} {names}".replace("  ", " ")


class Guide(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """What one document says about two releases; `guide` is `repository@ref:path`."""

    old: str
    new: str
    guide: str
    rows: tuple[Row, ...]


class Project(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The documents of one project; its clone is `<project>.git`."""

    project: str
    comparisons: tuple[Guide, ...]


def load(path: Path) -> Project:
    """Read a file of documented changes; an unknown key is an error."""
    return msgspec.yaml.decode(path.read_bytes(), type=Project)


def verdict(row: Row, changes: tuple[Change, ...]) -> str:
    """Return `found`, `wrong change` when the name is told with another change, or `missed`."""
    about = [change for change in changes if _is_about(row, change)]
    if any(change.change in _FOUND_BY[row.change] and _same_new(row, change) for change in about):
        return "found"
    return "wrong change" if about else "missed"


def told_instead(row: Row, changes: tuple[Change, ...]) -> Iterator[str]:
    """Yield what is told about the name of a row."""
    for change in changes:
        if _is_about(row, change):
            yield f"{change.change} {change.owner or change.package} {change.old or ''} -> {change.new or ''}"


def _is_about(row: Row, change: Change) -> bool:
    name = change.new if row.change == "added" else change.old
    if change.kind != row.kind or name is None or row.package not in {"", change.package}:
        return False
    return _folded(row.owner) in _folded(change.owner) and same_name(row.old or row.new, name)


def _folded(owner: str) -> str:
    """`point_cloud_xyz` and `PointCloudXyz` are one owner."""
    return owner.replace("_", "").lower()


def _same_new(row: Row, change: Change) -> bool:
    if not row.new or row.change in {"added", "replaced"}:
        return True
    return change.new is not None and same_name(row.new, change.new)


def same_name(documented: str, told: str) -> bool:
    """Whether two names are one: a namespace may stand before either, what is left open fits any word."""
    one, other = _plain(documented), _plain(told)
    return any(
        re.fullmatch(_pattern(first), second) or re.fullmatch(rf"(?:.*[./:])?{_pattern(first)}", second)
        for first, second in ((one, other), (other, one))
        if _HOLE.sub("", first).strip("./:_~")
    )


def _plain(name: str) -> str:
    return _PLACE.sub("", name).lstrip("~/")


def _pattern(name: str) -> str:
    return ".+".join(re.escape(part) for part in _HOLE.split(name))
