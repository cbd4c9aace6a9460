"""What holds at a point of a run: variables by scope, the path that leads there, paths that left."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Literal

import msgspec

from ecm_extract.cmake.values import Value, joined

MAX_VARIABLES: Final = 5_000
Scope = dict[str, Value]
Leave = Literal["return", "break", "continue", "stop"]
Where = Literal["here", "outside", "cache", "everywhere"]
"""Which scopes see what is set: the innermost, the one outside of it, those where no variable hides it, or all."""


def cached_name(name: str) -> str:
    """Return the name under which an entry of the cache is kept, which no variable can have."""
    return f"\x06CACHE\x06{name}"


class Path(msgspec.Struct, frozen=True):
    """How a command is reached.

    Attributes:
        conditions: that are not decided, as written.
        by_default: whether a build without settings of its own comes here; None where that is not known.
        is_test: whether only builds with tests do.
    """

    conditions: tuple[str, ...] = ()
    by_default: bool | None = True
    is_test: bool = False


@dataclass(frozen=True)
class Snapshot:
    """Variables at the end of a path, and whether builds without settings take it."""

    scopes: Sequence[Scope]
    by_default: bool | None


@dataclass(frozen=True)
class Left:
    """A path that left a body before its end."""

    how: Leave
    snapshot: Snapshot


class State:
    """The variables that are visible, innermost scope last, and where the run stands.

    Snapshots have the scopes themselves: one that a snapshot has is copied before anything is set in it.

    Args:
        begun: the variables of the outermost scope.

    Attributes:
        path: how the command at hand is reached.
        left: the paths that left the body at hand.
    """

    def __init__(self, begun: Scope) -> None:
        self.path = Path()
        self.left: list[Left] = []
        self._scopes = [begun]
        self._lent = [False]

    @property
    def variables(self) -> Mapping[str, Value]:
        """Those of the innermost scope; a scope starts as a copy of the one outside."""
        return self._scopes[-1]

    @property
    def depth(self) -> int:
        """How many scopes there are."""
        return len(self._scopes)

    def snapshot(self) -> Snapshot:
        """Return the variables as they are now."""
        self._lent = [True] * len(self._scopes)
        return Snapshot(tuple(self._scopes), self.path.by_default)

    def restore(self, scopes: Sequence[Scope]) -> None:
        """Go back to the scopes of a snapshot, or on with those of several that met."""
        self._scopes, self._lent = list(scopes), [True] * len(scopes)

    def enter(self, bound: Mapping[str, Value]) -> None:
        """Begin a scope, with variables of its own."""
        self._scopes.append({**self.variables, **bound})
        self._lent.append(False)

    def end(self) -> Mapping[str, Value]:
        """End the innermost scope, and return what it had."""
        self._lent.pop()
        return self._scopes.pop()

    def own(self, level: int = -1) -> Scope:
        """Return a scope that nobody else has, to be changed; the innermost one by default."""
        if self._lent[level]:
            self._scopes[level], self._lent[level] = dict(self._scopes[level]), False
        return self._scopes[level]

    def assign(self, name: str, value: Value, where: Where = "here") -> None:
        """Set a variable in the scopes that see it."""
        if where == "cache":
            value = msgspec.structs.replace(value, cached=True)
            self._keep(cached_name(name), value)
        for level in self._seen_in(name, where):
            scope = self._scopes[level]
            if name in scope or len(scope) < MAX_VARIABLES:
                self.own(level)[name] = value

    def _keep(self, name: str, value: Value) -> None:
        for level in range(self.depth):
            self.own(level)[name] = value

    def _seen_in(self, name: str, where: Where) -> Sequence[int]:
        innermost = self.depth - 1
        if where == "outside" and innermost:
            return [innermost - 1]
        if where not in {"cache", "everywhere"}:
            return [innermost]
        outer = [level for level, scope in enumerate(self._scopes[:-1]) if where != "cache" or _is_open(name, scope)]
        return [*outer, innermost]

    def leave(self, how: Leave) -> None:
        """Keep what holds here for the place where this path goes on."""
        self.left.append(Left(how, self.snapshot()))

    def below(self, condition: str, by_default: bool | None, is_test: bool) -> None:
        """Go on below a condition."""
        conditions = (*self.path.conditions, condition) if condition else self.path.conditions
        self.path = Path(conditions, both(self.path.by_default, by_default), self.path.is_test or is_test)


def _is_open(name: str, scope: Scope) -> bool:
    """Whether an entry of the cache is seen in a scope, since no variable hides it there."""
    return name not in scope or scope[name].cached


def meet(snapshots: Sequence[Snapshot], outside: Callable[[str], bool]) -> Sequence[Scope]:
    """Return what holds where paths meet; that of a build without settings comes first.

    Args:
        snapshots: at the end of each path.
        outside: tells whether a variable may be set by what is not read.
    """
    if len(snapshots) == 1:
        return snapshots[0].scopes
    ordered = sorted(snapshots, key=lambda each: each.by_default is not True)
    has_default = ordered[0].by_default is True
    depth = min(len(each.scopes) for each in ordered)
    return [_meet([each.scopes[level] for each in ordered], has_default, outside) for level in range(depth)]


def _meet(scopes: Sequence[Scope], has_default: bool, outside: Callable[[str], bool]) -> Scope:
    first, *others = scopes
    if all(scope is first for scope in others):
        return first
    met = dict(first)
    for name in dict.fromkeys(name for scope in scopes for name in scope):
        kept = first.get(name)
        if kept is None or any(scope.get(name) is not kept for scope in others):
            met[name] = joined([scope.get(name) or Value((None,), not outside(name)) for scope in scopes], has_default)
    return met


def both(one: bool | None, other: bool | None) -> bool | None:
    """And, of what may be unknown."""
    if one is False or other is False:
        return False
    return None if one is None or other is None else True


def either(one: bool | None, other: bool | None) -> bool | None:
    """Or, of what may be unknown."""
    return opposite(both(opposite(one), opposite(other)))


def opposite(one: bool | None) -> bool | None:
    """Not, of what may be unknown."""
    return None if one is None else not one
