"""Whether a run comes along a route: as few branches are decided as tell, and what is found for good is kept."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Literal

from ecm_extract.infer.routes import START, Fork, Route


class Leading:
    """Tells whether runs come along routes, by one reading of what decides branches."""

    def __init__(self, reading: Literal["live", "likely"], passes: Callable[[Fork, bool], bool]) -> None:
        """Take where routes keep the answer, and what tells whether one side of a branch may be taken."""
        self._reading = reading
        self._passes = passes

    def leads(self, route: Route, since: Route) -> bool:
        """Tell whether a run may come along a route from a place on it that it came by; none of it recurses."""
        known = {since: True}
        pending = [route]
        while pending:
            at = pending[-1]
            found = known[at] if at in known else self._found(at, known, since is START)
            if found is None:
                pending.append(next(before for before in at.before if before not in known))
            else:
                known[pending.pop()] = found
        return known[route]

    def _found(self, at: Route, known: Mapping[Route, bool], is_whole: bool) -> bool | None:
        """Whether a run comes to a place, by what is known of the places before it; None where that does not tell."""
        kept: bool | None = getattr(at, self._reading) if is_whole else None
        if kept is not None:
            return kept
        leading = next((before for before in at.before if known.get(before)), None)
        if leading is None:
            return None if any(before not in known for before in at.before) else self._never(at, is_whole)
        found = at.gate is None or self._passes(at.gate, at.holds)
        if is_whole and (at.gate is None or at.gate.found is not None) and self._is_kept(leading):
            setattr(at, self._reading, found)
        return found

    def _never(self, at: Route, is_whole: bool) -> bool:
        """No run comes to a place where none comes to any place before it."""
        if is_whole and all(map(self._is_kept, at.before)):
            setattr(at, self._reading, False)
        return False

    def _is_kept(self, route: Route) -> bool:
        return getattr(route, self._reading) is not None
