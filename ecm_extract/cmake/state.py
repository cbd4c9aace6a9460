"""What holds at a point of a run: variables by scope, the path that leads there, paths that left."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
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

    scopes: list[Scope]
    by_default: bool | None


@dataclass(frozen=True)
class Left:
    """A path that left a body before its end."""

    how: Leave
    snapshot: Snapshot


@dataclass
class State:
    """The variables that are visible, innermost scope last, and where the run stands."""

    scopes: list[Scope] = field(default_factory=lambda: [{}])
    path: Path = field(default_factory=Path)
    left: list[Left] = field(default_factory=list)

    @property
    def variables(self) -> Scope:
        """Those of the innermost scope; a scope starts as a copy of the one outside."""
        return self.scopes[-1]

    def snapshot(self) -> Snapshot:
        """Return the variables as they are now."""
        return Snapshot([dict(scope) for scope in self.scopes], self.path.by_default)

    def restore(self, snapshot: Snapshot) -> None:
        """Go back to a snapshot; it may be restored again."""
        self.scopes = [dict(scope) for scope in snapshot.scopes]

    def assign(self, name: str, value: Value, where: Where = "here") -> None:
        """Set a variable in the scopes that see it."""
        if where == "cache":
            value = msgspec.structs.replace(value, cached=True)
            self._keep(cached_name(name), value)
        for scope in self._seen_in(name, where):
            if name in scope or len(scope) < MAX_VARIABLES:
                scope[name] = value

    def _keep(self, name: str, value: Value) -> None:
        for scope in self.scopes:
            scope[name] = value

    def _seen_in(self, name: str, where: Where) -> list[Scope]:
        if where == "outside" and len(self.scopes) > 1:
            return [self.scopes[-2]]
        outer = self.scopes[:-1]
        if where == "cache":
            outer = [scope for scope in outer if name not in scope or scope[name].cached]
        return [*outer, self.scopes[-1]] if where in {"cache", "everywhere"} else [self.scopes[-1]]

    def leave(self, how: Leave) -> None:
        """Keep what holds here for the place where this path goes on."""
        self.left.append(Left(how, self.snapshot()))

    def below(self, condition: str, by_default: bool | None, is_test: bool) -> None:
        """Go on below a condition."""
        conditions = (*self.path.conditions, condition) if condition else self.path.conditions
        self.path = Path(conditions, both(self.path.by_default, by_default), self.path.is_test or is_test)


def meet(snapshots: list[Snapshot], outside: Callable[[str], bool]) -> list[Scope]:
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


def _meet(scopes: list[Scope], has_default: bool, outside: Callable[[str], bool]) -> Scope:
    first, *others = scopes
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
