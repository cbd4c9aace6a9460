"""Names that one consumer may have only, and that several take for themselves."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from collections.abc import Set as AbstractSet
from typing import Final, NamedTuple

import msgspec

from ecm_checker.hub.kinds import uses
from ecm_checker.match.engine import Match

_NOBODY: Final[AbstractSet[str]] = frozenset()


class _Taken(NamedTuple):
    """A name, and what is done with it."""

    use: str
    name: str


def contended(matches: Sequence[Match]) -> tuple[Match, ...]:
    """Return matches in their order; those of an exclusive name that two consumers surely take are incompatible."""
    takers = _takers(matches)
    return tuple(_judged(each, takers.get(_taken(each), _NOBODY)) for each in matches)


def _taken(found: Match) -> _Taken:
    return _Taken(found.requirement.use, found.requirement.name)


def _takers(matches: Iterable[Match]) -> Mapping[_Taken, AbstractSet[str]]:
    """Who takes a name, under no condition: others may exclude each other."""
    found: dict[_Taken, set[str]] = defaultdict(set)
    for each in matches:
        wanted = each.requirement
        if uses()[wanted.use].exclusive and not wanted.when and wanted.certainty != "unknown":
            found[_taken(each)].add(wanted.by)
    return found


def _judged(found: Match, takers: AbstractSet[str]) -> Match:
    if found.requirement.by not in takers or len(takers) == 1:
        return found
    return msgspec.structs.replace(found, state="incompatible", breach="claimed")
