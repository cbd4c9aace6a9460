"""One row per cause: what changed only since its package, node, program or file did is folded below that."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Final

import msgspec
from ecm_checker.hub.kinds import Cause
from ecm_checker.hub.provision import Provision
from ecm_checker.release import Change

from ecm_extract.diff.model import Located
from ecm_extract.diff.similarity import in_package

_GONE: Final = frozenset({"removed", "renamed", "moved"})
_PACKAGE: Final = "package"
_FILE: Final = "file"
_CALLED: Final[Mapping[Cause, Callable[[Provision], str]]] = {
    "module": lambda entity: entity.node or "",
    "program": lambda entity: entity.name,
    _FILE: lambda entity: entity.path,
}
"""What an entity that explains others is called by them."""
Causes = Mapping[tuple[str, ...], Change]


def folded(found: Iterable[Located]) -> list[Located]:
    """Return the changes; each that another one explains names it as its cause."""
    listed = list(found)
    causes = {key: entry.change for entry in listed for key in _explained(entry)}
    return [_with_cause(entry, causes) for entry in listed]


def cause_name(change: Change) -> str:
    """How other changes name a change that explains them: `node arm of robot_driver`."""
    of = f" of {change.package}" if not change.row.released else ""
    return f"{change.kind.replace('_', ' ')} {change.old}{of}"


def _with_cause(located: Located, causes: Causes) -> Located:
    if not located.change.breaking or located.change.change not in _GONE:
        return located
    found = [_cause(each, causes) for each in located.each]
    if found[0] is None or None in found:
        return located  # of one of its modules nothing else explains it
    return msgspec.structs.replace(located, change=msgspec.structs.replace(located.change, cause=cause_name(found[0])))


def _cause(located: Located, causes: Causes) -> Change | None:
    known = (causes.get(key) for key in _asked(located))
    return next((cause for cause in known if cause is not None and cause is not located.change), None)


def _explained(located: Located) -> Iterator[tuple[str, ...]]:
    """What a change explains."""
    change, old, new = located.change, located.pair.old, located.pair.new
    if old is None or not change.breaking:
        return
    cause = change.row.explains
    if cause == _PACKAGE:
        if change.change == "renamed" and new is not None:
            yield _PACKAGE, old.name, new.name
    elif cause and change.change == "removed" and _CALLED[cause](old):
        yield cause, old.package, _CALLED[cause](old)


def _asked(located: Located) -> Iterator[tuple[str, ...]]:
    """What would explain a change, the widest first."""
    change, old, new = located.change, located.pair.old, located.pair.new
    if old is None:
        return
    if new is not None and _is_same_but_for_package(old.name, new.name, (old.package, new.package)):
        yield _PACKAGE, old.package, new.package
    if change.change == "removed" and not old.sharers:
        for cause in old.row.below:
            yield cause, old.package, old.path if cause == _FILE else _owner(old)


def _owner(entity: Provision) -> str:
    """The program or module that an entity is of."""
    return entity.node or "" if entity.row.runs else entity.owner


def _is_same_but_for_package(old: str, new: str, packages: tuple[str, str]) -> bool:
    """Whether two names differ in the part that is the name of their package, if at all."""
    return packages[0] != packages[1] and in_package(old, *packages) == new
