"""What a variable holds at a place, and the state that all of them are in there."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from typing import TYPE_CHECKING, Final, Literal, NamedTuple

from ecm_parsers.source.expr import Expr

from ecm_extract.infer.layers import Layers
from ecm_extract.infer.routes import START, Fork, Gate, Route, fork, met_routes

if TYPE_CHECKING:
    from ecm_extract.link.running.env import Env

MAX_WAYS = 8
"""Different things that a variable may hold before it counts as unknown."""

MAX_COMPARED: Final = 1024
"""Pairs of things of which is asked, for one variable, whether one is all that the other is."""

MAX_REMEMBERED: Final = 64
"""Things that met of which all are remembered."""
_MET: Final = "met"
_BEGUN: Final = frozenset({"given", "shared"})
"""What each variable is at most once where a function begins, and that is made anew where it is asked for."""

How = Literal[
    "value",
    "each",
    "part",
    "made",
    "given",
    "shared",
    "lost",
    "read",
    "changed",
    "stored",
    "out",
    "handed",
    "reached",
    "looped",
    "after",
    "entered",
    "met",
    "caught",
]


@dataclass(slots=True, eq=False, repr=False)
class Held:
    """One thing that a variable can hold.

    Attributes:
        how: `value` of an expression; `each` element of one, or a `part` of such an element
            (`more`: where it stands in it); `made` without a value (a declaration); `given` from around the function
            or by its caller; `shared` with functions that may have given it anything they give it (of a variable of a
            module, `before` is what the module gives it);
            `lost`: nobody knows; `read` from a ROS parameter (`expr` its name, `more` its
            default); `changed` by a method (`expr` the call); `stored`: an element (`expr` the place, `more` the
            value); `out`: written by a function that got it (`expr` the call, `name` its parameter there); `handed` to
            somebody who may have changed what it consists of; `reached`: somebody may have changed its elements, not
            which ones it has; `looped`: what it held before a loop or after a round
            of it (`before`); `after` a method that may have changed it (`expr` the call, `name` the member in it);
            `entered`: what it held where somebody called the function (`env`, `before`); `met`: what it held on one of
            several routes (`parts`), of which not all may be taken; `caught`: an exception, which `expr` makes, or the
            statement of `env` raises.
        name: the variable, for messages and patterns; of `out` the parameter.
        env: where the expressions are evaluated.
        at: statement that made it so; -1 for none.
        before: what it held before.
        settled: what was found when it was evaluated, by the kind of question.
        parts: what it held on each of the routes that met, which parted at `since`.
        whole: of `met`, what it was before a test, of which only what passes that is left; None where none was made.
    """

    how: How
    name: str
    expr: Expr | None = None
    env: Env | None = None
    at: int = -1
    more: Expr | None = None
    before: tuple[Held, ...] = ()
    settled: dict[str, object] = field(default_factory=dict)
    parts: tuple[Part, ...] = ()
    since: Route = START
    whole: Held | None = None

    @property
    def length(self) -> int:
        """How many changes lead to it, along the first way."""
        count, held = 0, self
        while (held.before or held.parts) and held.how != "value" and "values" not in held.settled and count < 64:
            count, held = count + 1, (held.before or held.parts[0].ways)[0]
        return count


class Part(NamedTuple):
    """What a variable holds on one of several routes that meet."""

    route: Route
    ways: tuple[Held, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Turn:
    """One side of a branch that nobody can decide; each is itself only.

    Attributes:
        test: what is asked; None where nothing is, as for a round of a loop or a handler.
        holds: whether the test holds on this side.
        env: where the test is evaluated.
        left: how the other side left, which this one came past; empty within the branch.
        gate: the branch, where that is decided when somebody wants to know; None where it is not decided.
    """

    test: Expr | None = None
    holds: bool = True
    env: Env | None = None
    left: Literal["", "return", "throw"] = ""
    gate: Gate | None = None

    def past(self, left: Literal["return", "throw"]) -> Turn:
        """The same side behind the branch, which the other side left the function by."""
        return Turn(self.test, self.holds, self.env, left, self.gate)


@dataclass(slots=True, eq=False, repr=False)
class State:
    """What variables hold at one place on one way through a function.

    Attributes:
        holds: variable -> the things that it may hold, of which one is true.
        path: the branches on the way, by the side that was taken.
        route: the same branches, and all others that decide whether a run gets there.
        called: whether functions of the tree were called on it, which may have given members anything they give them.
    """

    holds: Layers = field(default_factory=Layers)
    path: tuple[Turn, ...] = ()
    route: Route = START
    called: bool = False

    def having(self, changes: Mapping[str, tuple[Held, ...]]) -> State:
        """The same state with other things in some variables."""
        if not changes:
            return self
        return State(self.holds.having(changes), self.path, self.route, self.called)

    def without(self, names: Iterable[str]) -> State:
        """The same state in which some variables are as if nobody had given them anything."""
        return self.having(dict.fromkeys(names, ()))

    def on(self, turn: Turn) -> State:
        """The same state on one side of a branch."""
        route = self.route.through(turn.gate, turn.holds) if turn.gate is not None else self.route
        return State(self.holds, (*self.path, turn), route, self.called)

    def through(self, fork: Fork, holds: bool) -> State:
        """The same state on one side of what decides which way a run takes, and is no branch."""
        return State(self.holds, self.path, self.route.through(fork, holds), self.called)

    def along(self, path: tuple[Turn, ...]) -> State:
        """The same state on another path."""
        return State(self.holds, path, self.route, self.called)


def joined_states(states: Iterable[State | None]) -> State | None:
    """What holds where several ways meet; None when no way gets there."""
    alive = [state for state in states if state is not None]
    if not alive:
        return None
    first, *others = alive
    for other in others:
        first = _joined(first, other)
    return first


def _joined(one: State, other: State) -> State:
    path, route = _common(one.path, other.path), met_routes(one.route, other.route)
    called = one.called or other.called
    if one.holds is other.holds:
        return State(one.holds, path, route, called)
    since = fork(one.route, other.route)
    met: dict[tuple[tuple[Held, ...], tuple[Held, ...]], tuple[Held, ...]] = {}
    holds: dict[str, tuple[Held, ...]] = {}
    for name in one.holds.apart(other.holds):
        left, right = one.holds.get(name), other.holds.get(name)
        if left and left is right:
            continue
        left, right = left or (_given(name, one),), right or (_given(name, other),)
        same = _before_tests(left, right)
        if same is not None:
            holds[name] = same
            continue
        key = (left, right)  # what two names share before, they share after
        if key not in met:
            parts = (Part(one.route, left), Part(other.route, right))
            alike = one.route is other.route
            met[key] = either(name, left, right) if alike else (Held("met", name, parts=parts, since=since),)
        holds[name] = met[key]
    return State(one.holds.having(holds), path, route, called)


def _before_tests(left: tuple[Held, ...], right: tuple[Held, ...]) -> tuple[Held, ...] | None:
    """What a variable held before tests let something of it pass on both ways; None where it was given anything since.

    What a test lets pass on its two sides is all of what was there.
    """
    if all(held.whole is None for held in (*left, *right)):
        return left if left == right else None
    known = [right]
    while known[-1] != (before := _untested(known[-1])):
        known.append(before)
    while left not in known:
        left, tested = _untested(left), left
        if left == tested:
            return None
    return left


def _untested(ways: tuple[Held, ...]) -> tuple[Held, ...]:
    return tuple([held.whole or held for held in ways])


def _given(name: str, state: State) -> Held:
    return Held("shared" if state.called and name.startswith(".") else "given", name)


def either(name: str, left: tuple[Held, ...], right: tuple[Held, ...]) -> tuple[Held, ...]:
    """Return what a variable may hold that holds one or the other; one of too many things is unknown."""
    own = any(held.how == "given" for held in left)
    more = [held for held in right if held not in left and not (own and held.how == "given")]
    ways = (*left, *more)
    ways = _as_reached(ways) if len(ways) > MAX_WAYS else ways
    return ways if len(ways) <= MAX_WAYS else (Held("lost", name, before=ways[:MAX_WAYS]),)


def _as_reached(ways: tuple[Held, ...]) -> tuple[Held, ...]:
    """The same, without what stands beside itself as somebody may have changed its elements, and may not have."""
    kept, known = list(ways), dict[tuple[Held, Held], bool]()
    for held in ways:
        if any(each is not held and _covers(each, held, known) for each in kept):
            kept.remove(held)
    return tuple(kept)


def _covers(wide: Held, held: Held, known: dict[tuple[Held, Held], bool]) -> bool:
    """Tell whether a thing is another one, or that with elements that somebody may have changed, on any route."""
    if wide is held or (_is_begun(wide) and _is_begun(held) and wide.how == held.how):
        return True
    asked = (wide, held)
    if len(known) >= MAX_COMPARED:
        return False
    if asked not in known:
        known[asked] = False  # who asks in a circle
        known[asked] = (
            (held.how == "met" and all(_covers(wide, each, known) for part in held.parts for each in part.ways))
            or (wide.how == "reached" and any(_covers(each, held, known) for each in wide.before))
            or (wide.how == "met" and all(_any_covers(part, held, known) for part in wide.parts))
        )
    return known[asked]


def _any_covers(part: Part, held: Held, known: dict[tuple[Held, Held], bool]) -> bool:
    return any(_covers(each, held, known) for each in part.ways)


def _is_begun(held: Held) -> bool:
    return held.how in _BEGUN and held.env is None


def all_ways(ways: Iterable[Held]) -> tuple[Held, ...]:
    """Return what a variable may hold on any route, whichever are taken."""
    found: dict[Held, None] = {}
    for held in ways:
        if held.how == "met":
            found.update(dict.fromkeys(_met_of(held)))
        else:
            found[held] = None
    return tuple(found)


def _met_of(met: Held) -> tuple[Held, ...]:
    """What met to make a thing, and what met to make that; few things are remembered, of which many states ask."""
    known = met.settled.get(_MET)
    if isinstance(known, tuple):
        return known
    found: dict[Held, None] = {}
    pending, seen = [met], set[Held]()
    while pending:
        held = pending.pop()
        if held.how != "met":
            found[held] = None
        elif held not in seen:
            seen.add(held)
            pending += reversed([way for part in held.parts for way in part.ways])
    if len(found) <= MAX_REMEMBERED:
        met.settled[_MET] = tuple(found)
    return tuple(found)


def common_path(states: Sequence[State]) -> tuple[Turn, ...]:
    """Return the branches that all of some states went through alike."""
    return reduce(_common, [state.path for state in states]) if states else ()


def _common(one: tuple[Turn, ...], other: tuple[Turn, ...]) -> tuple[Turn, ...]:
    """The branches that both ways went through alike."""
    count = 0
    while count < min(len(one), len(other)) and one[count] is other[count]:
        count += 1
    return one[:count]
