"""Which routes through a function are taken: each branch is decided once, and only if somebody wants to know."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Final

from ecm_extract.infer.held import Held, Part, State, Turn
from ecm_extract.infer.kinds import any_fits
from ecm_extract.infer.routes import OPEN, START, Fitting, Fork, Gate, Route, Verdict
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.leading import Leading
from ecm_extract.link.running.ways import Ways

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder
    from ecm_extract.link.running.truths import Truths

MAX_DECIDING: Final = 8
"""Functions whose branches are decided within a branch of another."""
MAX_NESTED: Final = 60
"""Branches that are decided within others."""
MAX_RECURSION: Final = 2
"""Runs of one function of which branches are decided within each other."""


class Decisions:
    """Decides branches, and tells what follows for places and variables."""

    def __init__(self, folder: Folder, truths: Truths) -> None:
        self.folder = folder
        self._truths = truths
        self._deciding: dict[Fork, None] = {}
        self._meanwhile: dict[Fork, Verdict] = {}
        self._live = Leading(
            folder, "live", lambda fork, holds: self.of(fork).holds is not (not holds), self._is_decided
        )
        self._likely = Leading(
            folder, "likely", lambda fork, holds: self.of(fork).likely is not (not holds), self._is_decided
        )
        self._taken = Ways(folder, "taken", self._live_parts)
        self._expected = Ways(folder, "expected", self._likely_parts)

    @property
    def deciding(self) -> Iterable[Func]:
        """The functions of which a branch is decided right now."""
        return [fork.env.func for fork in self._deciding]

    def of(self, fork: Fork) -> Verdict:
        """Tell whether what a branch asks holds; that is open for who asks in a circle, or too deep."""
        known = fork.found or self._meanwhile.get(fork)
        if known is not None:
            return known
        if not self._may_decide(fork):
            self.folder.cuts += 1
            return OPEN
        cuts = self.folder.cuts
        self._deciding[fork] = None
        self._moved_on()
        try:
            with self.folder.steps.apart(), self.folder.steps.without_a_word():
                found = self._asked(fork)
        finally:
            del self._deciding[fork]
            self._moved_on()
        if cuts == self.folder.cuts or not self.folder.flow.is_busy:
            fork.found = found
        else:
            self._meanwhile[fork] = found
        self.folder.flow.answered()
        return found

    def _asked(self, fork: Fork) -> Verdict:
        if isinstance(fork, Gate):
            return self._truths.verdict(fork.test, fork.env)
        if isinstance(fork, Fitting):
            self.of(fork.raising)
            kinds = fork.raising.kinds
            fits = any_fits(kinds, fork.caught) if kinds is not None else None
            return Verdict(fits, fits)
        raises, fork.kinds, _ = self.folder.returns.raises.of(fork.env)
        return Verdict(raises, raises)

    def answered(self) -> None:
        """Forget what held only within a question."""
        self._meanwhile.clear()
        self._live.answered()
        self._likely.answered()
        self._moved_on()

    def _moved_on(self) -> None:
        for each in (self._live, self._likely, self._taken, self._expected):
            each.moved_on()

    def _is_decided(self, fork: Fork) -> bool:
        """Whether what a branch asks is decided, if only until the question at hand is answered."""
        return fork.found is not None or fork in self._meanwhile

    def _may_decide(self, fork: Fork) -> bool:
        """Whether a branch is neither asked for by itself, nor deeper than is followed."""
        if fork in self._deciding or len(self._deciding) >= MAX_NESTED:
            return False
        runs = list(dict.fromkeys((each.env.func, self.folder.flow.keys.of(each.env)) for each in self._deciding))
        own = (fork.env.func, self.folder.flow.keys.of(fork.env))
        if own in runs:
            return True
        return len(runs) < MAX_DECIDING and sum(func is fork.env.func for func, _ in runs) < MAX_RECURSION

    # --- places --------------------------------------------------------------------------------------------

    def is_live(self, route: Route, since: Route = START) -> bool:
        """Tell whether a run may come along a route, from a place on it that it came by."""
        return self._live.leads(route, since)

    def is_likely(self, route: Route, since: Route = START) -> bool:
        """Tell whether a run comes along a route as long as nobody sets a parameter, or whether nothing tells that."""
        return self._likely.leads(route, since)

    def live(self, states: Sequence[State]) -> Sequence[State]:
        """Return the states that a run may be in; all of them where no run gets there."""
        if len(states) <= 1:
            return states
        return [state for state in states if self.is_live(state.route)] or states

    def turns(self, path: Sequence[Turn]) -> tuple[Turn, ...]:
        """Return the branches of a path that nobody can decide, by the side that was taken."""
        return tuple(turn for turn in path if turn.gate is None or self.of(turn.gate).holds is None)

    def likely(self, states: Sequence[State]) -> Sequence[State]:
        """Return the states that a run may be in as long as nobody sets a parameter; all where it is in none."""
        live = self.live(states)
        return live if len(live) <= 1 else [state for state in live if self.is_likely(state.route)] or live

    # --- variables -----------------------------------------------------------------------------------------

    def ways(self, helds: tuple[Held, ...], likely: bool = False) -> tuple[Held, ...]:
        """Return what a variable may hold on the routes that may be taken, or on those that likely are."""
        return (self._expected if likely else self._taken).of(helds)

    def _live_parts(self, held: Held) -> Sequence[Part]:
        """The parts on routes that may be taken, likely ones first; all of them where none may, but of a test."""
        since = held.since
        live = [part for part in held.parts if self.is_live(part.route, since)]
        if not live and held.whole is None:
            live = list(held.parts)
        return live if len(live) <= 1 else sorted(live, key=lambda part: not self.is_likely(part.route, since))

    def _likely_parts(self, held: Held) -> Sequence[Part]:
        """The parts on routes that may be taken and are likely; all that may be taken where none is."""
        live = self._live_parts(held)
        return live if len(live) <= 1 else [part for part in live if self.is_likely(part.route, held.since)] or live
