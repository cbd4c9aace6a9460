"""Which routes through a function are taken: each branch is decided once, and only if somebody wants to know."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING, Final

from ecm_extract.infer.held import Held, Part, State, Turn, either
from ecm_extract.infer.routes import OPEN, START, Gate, Route, Verdict
from ecm_extract.link.units import Func

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder
    from ecm_extract.link.truths import Truths

MAX_DECIDING: Final = 8
"""Functions whose branches are decided within a branch of another."""
MAX_NESTED: Final = 60
"""Branches that are decided within others."""
MAX_RECURSION: Final = 2
"""Runs of one function of which branches are decided within each other."""
_LIVE: Final = "live"


class Decisions:
    """Decides branches, and tells what follows for places and variables."""

    def __init__(self, folder: Folder, truths: Truths) -> None:
        self.folder = folder
        self._truths = truths
        self._deciding: dict[Gate, None] = {}
        self._meanwhile: dict[Gate, Verdict] = {}

    @property
    def deciding(self) -> Iterable[Func]:
        """The functions of which a branch is decided right now."""
        return [gate.env.func for gate in self._deciding]

    def of(self, gate: Gate) -> Verdict:
        """Tell whether what a branch asks holds; that is open for who asks in a circle, or too deep."""
        known = gate.found or self._meanwhile.get(gate)
        if known is not None:
            return known
        if not self._may_decide(gate):
            self.folder.cuts += 1
            return OPEN
        cuts = self.folder.cuts
        self._deciding[gate] = None
        try:
            with self.folder.steps.apart():
                found = self._truths.verdict(gate.test, gate.env)
        finally:
            del self._deciding[gate]
        if cuts == self.folder.cuts or not self.folder.flow.is_busy:
            gate.found = found
        else:
            self._meanwhile[gate] = found
        if not self.folder.flow.is_busy:
            self._meanwhile.clear()
        return found

    def _may_decide(self, gate: Gate) -> bool:
        """Whether a branch is neither asked for by itself, nor deeper than is followed."""
        if gate in self._deciding or len(self._deciding) >= MAX_NESTED:
            return False
        runs = list(dict.fromkeys((each.env.func, self.folder.flow.keys.of(each.env)) for each in self._deciding))
        own = (gate.env.func, self.folder.flow.keys.of(gate.env))
        if own in runs:
            return True
        return len(runs) < MAX_DECIDING and sum(func is gate.env.func for func, _ in runs) < MAX_RECURSION

    # --- places --------------------------------------------------------------------------------------------

    def is_live(self, route: Route, since: Route = START) -> bool:
        """Tell whether a run may come along a route, from a place on it that it came by."""
        return _any_leads(route, {since: True}, lambda gate, holds: self.of(gate).holds is not (not holds))

    def is_likely(self, route: Route, since: Route = START) -> bool:
        """Tell whether a run comes along a route as long as nobody sets a parameter, or whether nothing tells that."""
        return _any_leads(route, {since: True}, lambda gate, holds: self.of(gate).likely is not (not holds))

    def live(self, states: Sequence[State]) -> Sequence[State]:
        """Return the states that a run may be in; all of them where no run gets there."""
        if len(states) <= 1:
            return states
        return [state for state in states if self.is_live(state.route)] or states

    def turns(self, state: State) -> tuple[Turn, ...]:
        """Return the branches on the way to a state that nobody can decide, by the side that was taken."""
        return tuple(turn for turn in state.path if turn.gate is None or self.of(turn.gate).holds is None)

    # --- variables -----------------------------------------------------------------------------------------

    def ways(self, helds: tuple[Held, ...]) -> tuple[Held, ...]:
        """Return what a variable may hold on the routes that may be taken."""
        if all(held.how != "met" for held in helds):
            return helds
        found: tuple[Held, ...] = ()
        for held in helds:
            found = either(held.name, found, self._met(held) if held.how == "met" else (held,))
        return found

    def _met(self, held: Held) -> tuple[Held, ...]:
        known = held.settled.get(_LIVE)
        if isinstance(known, tuple):
            return known
        cuts = self.folder.cuts
        found: tuple[Held, ...] = ()
        for part in self._taken(held):
            found = either(held.name, found, self.ways(part.ways))
        if cuts == self.folder.cuts:
            held.settled[_LIVE] = found
        return found

    def _taken(self, held: Held) -> Sequence[Part]:
        """The parts on routes that may be taken, likely ones first; all of them where none may."""
        since = held.since
        live = [part for part in held.parts if self.is_live(part.route, since)] or held.parts
        return live if len(live) == 1 else sorted(live, key=lambda part: not self.is_likely(part.route, since))


def _any_leads(route: Route, known: dict[Route, bool], passes: Callable[[Gate, bool], bool]) -> bool:
    """Whether one of the ways along a route passes all branches on it."""
    found = known.get(route)
    if found is None:
        found = known[route] = _leads(route, known, passes)
    return found


def _leads(route: Route, known: dict[Route, bool], passes: Callable[[Gate, bool], bool]) -> bool:
    if not route.before:
        return route is START
    if not any(_any_leads(before, known, passes) for before in route.before):
        return False
    return route.gate is None or passes(route.gate, route.holds)
