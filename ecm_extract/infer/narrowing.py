"""What a test tells of the variables that it asks for: behind `if not name: return` no empty name is left.

Which of the things that a variable may hold pass the test is decided when somebody wants to know its value.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Final

from ecm_parsers.source.expr import Expr, Lambda

from ecm_extract.infer.held import Held, Part, State
from ecm_extract.infer.routes import START, Gate, Route
from ecm_extract.infer.run import Frame
from ecm_extract.link.code.walk import children

MAX_ASKED: Final = 24
"""Things that a variable may hold, with the places where they met; of more, a test tells nothing."""


@dataclass(frozen=True, slots=True)
class Narrowing:
    """What a test tells of one variable.

    Attributes:
        ways: what the variable may hold before.
        gates: what is asked of each thing that met to make these.
        route: how the test is reached.
    """

    ways: tuple[Held, ...]
    gates: Mapping[Held, Gate]
    route: Route

    def on(self, holds: bool) -> tuple[Held, ...]:
        """Return what the variable may hold on one side of the test."""
        return tuple(self._narrowed(held, holds, frozenset()) for held in self.ways)

    def _narrowed(self, held: Held, holds: bool, around: frozenset[Held]) -> Held:
        parts = _parts(held, self.route) if held not in around else ()
        if not parts:
            passing = Part(self.route.through(self.gates[held], holds), (held,))
            return Held("met", held.name, parts=(passing,), since=self.route, whole=held)
        within = around | {held}
        left = [Part(part.route, tuple(self._narrowed(way, holds, within) for way in part.ways)) for part in parts]
        since = held.since if held.how == "met" else self.route
        return Held("met", held.name, parts=tuple(left), since=since, whole=held)


def _parts(held: Held, route: Route) -> tuple[Part, ...]:
    """The things that one stands for, by their routes; none for one that is itself only."""
    return held.parts if held.how != "looped" else tuple(Part(route, (way,)) for way in held.before)


def narrowings(frame: Frame, test: Expr, state: State) -> Mapping[str, Narrowing]:
    """Return what a test tells of variables that may hold one of several things."""
    found: dict[str, Narrowing] = {}
    for name in dict.fromkeys(_variables(frame, test)) if frame.whole else ():
        ways = state.holds.get(name) or ()
        asked = _each(ways)
        if 1 < len(asked) <= MAX_ASKED:
            alone = [held for held in asked if held.how != "met"]
            gates = {held: Gate(test, frame.place(state.having({name: (held,)}))) for held in alone}
            found[name] = Narrowing(ways, gates, state.route)
    return found


def _variables(frame: Frame, test: Expr) -> Iterator[str]:
    """Yield the variables that a test asks for; what stands in a lambda is asked when that is called."""
    if isinstance(test, Lambda):
        return
    key = frame.effects.key(test)
    if key:
        yield key
    for part in children(test):
        yield from _variables(frame, part)


def _each(ways: tuple[Held, ...]) -> Mapping[Held, None]:
    """Return all that a variable may hold, and what met to make it, as far as anybody asks for these."""
    found: dict[Held, None] = {}
    pending = list(ways)
    while pending and len(found) <= MAX_ASKED:
        held = pending.pop()
        if held not in found:
            found[held] = None
            pending += [way for part in _parts(held, START) for way in part.ways]
    return found
