"""Lines that ask for one thing or another, as a subscription that a parameter gives one of two types."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from ecm_checker.contract import Evidence
from ecm_checker.hub.requirement import Requirement
from ecm_checker.match.engine import Match


class _Asked(NamedTuple):
    """Who asks for which name in which line."""

    by: str
    use: str
    name: str
    at: Evidence


def alternatives(matches: Sequence[Match]) -> tuple[Match, ...]:
    """Return matches in their order; what does not fit where another one of its line is met may never be asked for."""
    met = {_asked(each.requirement) for each in matches if each.state == "met"}
    return tuple(_judged(each, _asked(each.requirement) in met) for each in matches)


def _asked(wanted: Requirement) -> _Asked:
    return _Asked(wanted.by, wanted.use, wanted.name, wanted.evidence[0])


def _judged(found: Match, other_is_met: bool) -> Match:
    if found.state != "incompatible" or not other_is_met:
        return found
    return Match(found.requirement, "unknown", found.found)
