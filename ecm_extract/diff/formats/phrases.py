"""How a change is put in words, the same in every format for people."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import msgspec
from ecm_checker.contract import Evidence
from ecm_checker.hub.kinds import kinds_that
from ecm_checker.release import Change

from ecm_extract.diff.model import Comparison
from ecm_extract.diff.steps import ShortStep
from ecm_extract.report.terminal import one_line
from ecm_extract.report.unread_text import unread_lines

_MOST_NAMED = 4
_RANK = {"removed": 0, "renamed": 1, "moved": 2, "type_changed": 3, "signature_changed": 4}


def incomplete(comparison: Comparison) -> str:
    """Say in one line that the verdict is not of the whole, and why; empty where it is."""
    gaps = [part for part in comparison.unread if part.limits]
    return f"not everything could be read: {'; '.join(unread_lines(gaps))}" if gaps else ""


def left_out(comparison: Comparison) -> list[str]:
    """Say what was not read and hides no change, one line for each reason."""
    return unread_lines(part for part in comparison.unread if part.carries and not part.limits)


def by_package(changes: tuple[Change, ...]) -> list[tuple[str, list[Change]]]:
    """Group changes by package, the package with most breaking changes first, most breaking first within."""
    groups: dict[str, list[Change]] = {}
    for change in changes:
        groups.setdefault(change.package, []).append(change)
    for members in groups.values():
        members.sort(key=weight)
    return sorted(groups.items(), key=lambda item: (-sum(change.breaking for change in item[1]), item[0]))


def weight(change: Change) -> tuple[bool, int, int, str, str]:
    """Order of changes: breaking first, then what reaches most people, then what is gone."""
    first = kinds_that(lambda row: row.first)
    kind = first.index(change.kind) if change.kind in first else len(first)
    return not change.breaking, kind, _RANK.get(change.change, 9), change.owner, change.old or change.new or ""


def subject(change: Change) -> str:
    """`parameter a -> b`, with the owner."""
    kind = change.kind.replace("_", " ")
    owner = f"{change.owner}: " if change.owner else ""
    old, new = change.old, change.new
    if old and new and old != new:
        return one_line(f"{kind} {owner}{old} -> {new}", 300)
    return one_line(f"{kind} {owner}{old or new}", 300)


def values(change: Change) -> str:
    """` (10.0 -> 20.0)` where a default is what changed; empty where the names tell."""
    if change.change != "default_changed":
        return ""
    return one_line(f" ({_shown(change.old_value)} -> {_shown(change.new_value)})")


def _shown(value: str | None) -> str:
    return "none" if value is None else value or "''"


def place(change: Change, where: Callable[[Evidence], Evidence] = lambda entry: entry) -> str:
    """Where the change can be seen: the new line, else the line at the old ref; `where` gives the path for readers."""
    at = change.evidence_new or change.evidence_old
    if at is None:
        return ""
    return one_line(f"{where(at).path}:{at.line}{'' if change.evidence_new is not None else ' (old)'}")


def counted(number: int, what: str) -> str:
    """`1 change`, `2 changes`."""
    return f"{number} {what}{'' if number == 1 else 's'}"


def step_lines(short: Sequence[ShortStep]) -> Iterator[str]:
    """Say which packages take too small a version step, and the version that would do; alike packages in one line."""
    groups: dict[ShortStep, list[str]] = {}
    for step in short:
        groups.setdefault(msgspec.structs.replace(step, package=""), []).append(step.package)
    for step, names in groups.items():
        more = f" and {len(names) - _MOST_NAMED} more" if len(names) > _MOST_NAMED else ""
        versions = f"{step.old_version or '?'} -> {step.new_version or 'gone'}"
        takes = f"declares {step.declared or 'no step that can be read'}, needs {step.required}"
        do = f"release as {step.enough}" if step.enough and step.new_version else "say so by the step of the others"
        yield one_line(f"version: {', '.join(names[:_MOST_NAMED])}{more} {versions} {takes}: {do}", 600)


def instead(change: Change) -> str:
    """What a user writes instead."""
    if change.change in {"renamed", "moved"} and change.new:
        return f"use `{one_line(change.new)}`"
    if change.change == "removed":
        return "remove it"
    return one_line(change.reason, 300)
