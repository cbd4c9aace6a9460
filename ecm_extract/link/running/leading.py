"""Whether a run comes along a route: as few branches are decided as tell, and what is found is kept."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from ecm_extract.infer.routes import START, Fork, Route

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


@dataclass(slots=True)
class _Found:
    """What is found of routes from one place on, and whether a bound had a say in any of it."""

    known: dict[Route, bool]
    is_cut: bool = False


class Leading:
    """Tells whether runs come along routes, by one reading of what decides branches."""

    def __init__(
        self,
        folder: Folder,
        reading: Literal["live", "likely"],
        passes: Callable[[Fork, bool], bool],
        is_decided: Callable[[Fork], bool],
    ) -> None:
        """Take where routes keep the answer, what tells whether one side may be taken, and whether that stays so.

        What stays so only as long as a question is answered is kept until then (see `answered`).
        """
        self._folder = folder
        self._reading = reading
        self._passes = passes
        self._is_decided = is_decided
        self._meanwhile: dict[Route, bool] = {}
        self._found_since: dict[Route, _Found] = {}

    def answered(self) -> None:
        """Forget what held only within a question."""
        self._meanwhile.clear()

    def moved_on(self) -> None:
        """Forget what held only as long as the same branches were being decided."""
        self._found_since.clear()

    def leads(self, route: Route, since: Route) -> bool:
        """Tell whether a run may come along a route from a place on it that it came by; none of it recurses."""
        found = self._found_since.get(since)
        if found is None:
            found = self._found_since[since] = _Found({since: True})
        if route in found.known:
            self._folder.cuts += found.is_cut
            return found.known[route]
        cuts = self._folder.cuts
        self._walk(route, since, found.known)
        if self._found_since.get(since) is found:
            found.is_cut = found.is_cut or self._folder.cuts != cuts
        return found.known[route]

    def _walk(self, route: Route, since: Route, known: dict[Route, bool]) -> None:
        """Find whether a run may come along a route, and along those that it needs for that."""
        is_whole = since is START or self._kept(since) is True  # whoever comes by there comes from the beginning
        pending = [route]
        while pending:
            at = pending[-1]
            found = known[at] if at in known else self._found(at, known, is_whole)
            if found is None:
                pending.append(next(before for before in at.before if before not in known))
            else:
                known[pending.pop()] = found

    def _found(self, at: Route, known: Mapping[Route, bool], is_whole: bool) -> bool | None:
        """Whether a run comes to a place, by what is known of the places before it; None where that does not tell."""
        kept = self._kept(at) if is_whole else None
        if kept is not None:
            return kept
        leading = None
        for before in at.before:
            found = known.get(before)
            if found:
                leading = before
                break
        if leading is None:
            return None if any(before not in known for before in at.before) else self._never(at, is_whole)
        passed = at.gate is None or self._passes(at.gate, at.holds)
        if is_whole:
            self._keep(at, passed, leading)
        return passed

    def _keep(self, at: Route, found: bool, leading: Route) -> None:
        """Keep whether a run comes to a place that it comes to from another one."""
        gate = at.gate
        if (gate is None or gate.found is not None) and self._is_for_good(leading):
            setattr(at, self._reading, found)
        elif (gate is None or self._is_decided(gate)) and self._kept(leading) is not None:
            self._meanwhile[at] = found

    def _never(self, at: Route, is_whole: bool) -> bool:
        """No run comes to a place where none comes to any place before it."""
        if is_whole and all(map(self._is_for_good, at.before)):
            setattr(at, self._reading, False)
        elif is_whole and all(self._kept(before) is not None for before in at.before):
            self._meanwhile[at] = False
        return False

    def _kept(self, route: Route) -> bool | None:
        kept: bool | None = getattr(route, self._reading)
        return self._meanwhile.get(route) if kept is None else kept

    def _is_for_good(self, route: Route) -> bool:
        return getattr(route, self._reading) is not None
