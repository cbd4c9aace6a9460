"""How places are reached: which sides of branches lead there, past what; each is decided when somebody asks.

Most of what a function asks decides nothing that anybody wants to know of it, and asking is what takes time.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

from ecm_parsers.source.expr import Expr

if TYPE_CHECKING:
    from ecm_extract.infer.kinds import Kind
    from ecm_extract.link.running.env import Env


class Verdict(NamedTuple):
    """Whether a condition holds: proved, and as long as nobody sets a parameter; None when that is not known."""

    holds: bool | None
    likely: bool | None


OPEN: Final = Verdict(None, None)


@dataclass(slots=True, eq=False)
class Gate:
    """What a branch asks, and where.

    Attributes:
        test: the condition.
        env: where it is evaluated.
        found: what it is decided to be, once somebody wanted to know (see `Judge.decided`).
    """

    test: Expr
    env: Env
    found: Verdict | None = None


@dataclass(slots=True, eq=False)
class Raising:
    """Whether a statement raises.

    Attributes:
        env: the statement, in the state in which it is reached.
        found: whether it does, once somebody wanted to know.
        kinds: what it raises then, of which each is possible; None where that is not known.
    """

    env: Env
    found: Verdict | None = None
    kinds: frozenset[Kind] | None = None


@dataclass(slots=True, eq=False)
class Fitting:
    """Whether a handler is for what a statement raises.

    Attributes:
        raising: the statement.
        caught: the types that the handler is for; None for one that nobody knows.
        found: whether it is, once somebody wanted to know.
    """

    raising: Raising
    caught: tuple[Kind | None, ...]
    found: Verdict | None = None

    @property
    def env(self) -> Env:
        """The place of the statement."""
        return self.raising.env


Fork: TypeAlias = Gate | Raising | Fitting
"""What decides which way a run takes."""


@dataclass(slots=True, eq=False)
class Route:
    """How a place is reached; each is itself only.

    Attributes:
        before: the routes that lead here, of which any is taken; none where a function begins.
        gate: what decides whether it is taken from there; None where several meet.
        holds: the side of it.
        depth: how many branches lie behind it since routes met, or the function began.
        live: whether a run may come here, once that is decided for good.
        likely: whether one does as long as nobody sets a parameter, likewise.
    """

    before: tuple[Route, ...] = ()
    gate: Fork | None = None
    holds: bool = True
    depth: int = 0
    live: bool | None = None
    likely: bool | None = None

    def through(self, gate: Fork, holds: bool) -> Route:
        """The route on one side of a branch."""
        return Route((self,), gate, holds, depth=self.depth + 1)


START: Final = Route(live=True, likely=True)
NOWHERE: Final = Route(live=False, likely=False)
"""The route to code that no run reaches."""


def met_routes(one: Route, other: Route) -> Route:
    """Return the route to where two meet; both sides of one branch lead to where it was come from."""
    both = one.gate is not None and one.gate is other.gate and one.holds is not other.holds
    if one is other or (both and one.before == other.before):
        return one if one is other else one.before[0]
    return Route(tuple(dict.fromkeys((*_met(one), *_met(other)))))


def fork(one: Route, other: Route) -> Route:
    """Return the last place that both routes surely came by: what decided whether that is reached is the same."""
    while one is not other:
        deeper, shallower = (one, other) if one.depth >= other.depth else (other, one)
        if not deeper.depth:
            return START
        one, other = deeper.before[0], shallower
    return one


def _met(route: Route) -> Iterable[Route]:
    """What a place where routes meet is reached by; another one by itself."""
    return route.before if route.gate is None and route.before else (route,)
