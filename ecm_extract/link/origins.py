"""What gives a variable what it holds: the run of its function tells it, and of a member the runs of all methods."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Constant, Expr, Member, Name

from ecm_extract.infer.held import Held
from ecm_extract.link.env import MAX_DEPTH, Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder

_NULL: Final = (Constant("null"), Name("NULL"))
"""What a pointer is given that is no object."""


class Origins:
    """Follows variables back to where they are given something."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def held(self, expr: Expr, env: Env) -> list[Held]:
        """Return what a variable may hold at a place, each with where it is evaluated; nothing where that is unknown.

        Of a member that the function at hand leaves alone it is what all methods leave it with; of a variable of a
        namespace what functions assign to it.
        """
        if not isinstance(expr, Name | Member):
            return []
        ways = self.folder.flow.ways(expr, env)
        if ways:
            return list(_placed((held, env) for way in ways for held in way))
        return self._around(self.folder.flow.effects(env.func).key(expr), env)

    def of(self, expr: Expr, env: Env) -> list[Held]:
        """Return the same, each as it was given: through loops, calls of methods, and callers that are known."""
        found: dict[Held, None] = {}
        pending = self.held(expr, env)
        seen: set[Held] = set()
        while pending:
            held = pending.pop(0)
            if held in seen or held.env is None:
                continue
            seen.add(held)
            behind = self._behind(held, held.env)
            if behind is None:
                found[held] = None
            else:
                pending += behind
        return list(found)

    def makers(self, expr: Expr, env: Env) -> list[Bound] | None:
        """Return the expressions that may have made an object; None where one of them is not known."""
        found: list[Bound] = []
        for held in self.of(expr, env):
            if held.how == "made" or (held.how == "value" and held.expr in _NULL):
                continue
            if held.how != "value" or held.expr is None or held.env is None:
                return None
            found.append(Bound(held.expr, held.env))
        return found

    def _behind(self, held: Held, env: Env) -> list[Held] | None:
        """What a variable held before nothing was done to it that matters; None for what it was given."""
        if env.depth > MAX_DEPTH:
            self.folder.cuts += 1
            return None
        if held.how in {"looped", "handed", "entered"} or (held.how in {"given", "shared"} and held.before):
            return list(_placed((before, env) for before in held.before))
        if held.how in {"given", "shared"}:
            entered = self.folder.states.entered(held.name, env) if held.how == "given" else None
            return list(_placed([(entered, env)])) if entered is not None else self._around(held.name, env) or None
        left = self.folder.held.left(held, env) if held.how == "after" else None
        left = self.folder.held.out(held, env) if held.how == "out" else left
        return list(_placed((each, left[1]) for each in left[0])) if left is not None else None

    def _around(self, key: str, env: Env) -> list[Held]:
        """What a variable holds that the function at hand has not given anything."""
        cls = env.this or env.func.cls
        if key.startswith("."):
            known = cls is not None and key.count(".") == 1
            return list(_placed(self.folder.members.sources(key[1:], cls, env))) if known and cls is not None else []
        given = self.folder.names.argument(key, env)
        if given is not None:
            return [Held("value", key, given.expr, given.env)]
        return list(self._assigned(key, env)) if "." not in key else []

    def _assigned(self, name: str, env: Env) -> Iterator[Held]:
        for entry in self.folder.objects.file_scope.definitions(name, env):
            place = Env(entry.func, entry.at, this=entry.func.cls, depth=env.depth + 1)
            yield Held("value", name, entry.statement.value, place, entry.at)


def _placed(found: Iterable[tuple[Held, Env]]) -> Iterator[Held]:
    """Each with the place at which it is evaluated."""
    for held, env in found:
        yield held if held.env is not None else replace(held, env=env, settled={})
