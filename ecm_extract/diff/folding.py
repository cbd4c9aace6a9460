"""One row per cause: what changed only since its package, node, program or file did is folded below that."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Final

import msgspec
from ecm_checker.release import Change

from ecm_extract.diff.model import Located
from ecm_extract.diff.module_homes import KINDS as ENDPOINTS
from ecm_extract.diff.similarity import in_package

_GONE: Final = frozenset({"removed", "renamed", "moved"})
_DECLARED: Final = frozenset({"class", "function", "constant", "method", "member"})
Causes = Mapping[tuple[str, ...], Change]


def folded(found: Iterable[Located]) -> list[Located]:
    """Return the changes; each that another one explains names it as its cause."""
    listed = list(found)
    causes = {key: entry.change for entry in listed for key in _explained(entry)}
    return [_with_cause(entry, causes) for entry in listed]


def cause_name(change: Change) -> str:
    """How other changes name a change that explains them: `node arm of robot_driver`."""
    of = f" of {change.package}" if change.kind != "package" else ""
    return f"{change.kind.replace('_', ' ')} {change.old}{of}"


def _with_cause(located: Located, causes: Causes) -> Located:
    if not located.change.breaking or located.change.change not in _GONE:
        return located
    for key in _asked(located):
        cause = causes.get(key)
        if cause is not None and cause is not located.change:
            return Located(msgspec.structs.replace(located.change, cause=cause_name(cause)), located.pair)
    return located


def _explained(located: Located) -> Iterator[tuple[str, ...]]:
    """What a change explains."""
    change, old, new = located.change, located.pair.old, located.pair.new
    if old is None or not change.breaking:
        return
    if change.kind == "package" and change.change == "renamed" and new is not None:
        yield "package", old.name, new.name
    elif change.change == "removed":
        if change.kind == "node" and old.node:
            yield "module", old.package, old.node
        elif change.kind == "executable":
            yield "program", old.package, old.name
        elif change.kind == "file":
            yield "file", old.package, old.path


def _asked(located: Located) -> Iterator[tuple[str, ...]]:
    """What would explain a change, the widest first."""
    change, old, new = located.change, located.pair.old, located.pair.new
    if old is None:
        return
    if new is not None and _is_same_but_for_package(old.name, new.name, (old.package, new.package)):
        yield "package", old.package, new.package
    if change.change != "removed":
        return
    if change.kind == "node":
        yield "program", old.package, old.node or ""
    if change.kind in ENDPOINTS and not old.sharers:
        yield "program", old.package, old.owner
        yield "module", old.package, old.owner
    if change.kind in _DECLARED:
        yield "file", old.package, old.path


def _is_same_but_for_package(old: str, new: str, packages: tuple[str, str]) -> bool:
    """Whether two names differ in the part that is the name of their package, if at all."""
    return packages[0] != packages[1] and in_package(old, *packages) == new
