"""What gives a variable what it holds: the run of its function tells it, and of a member the runs of all methods."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Expr, Member, Name

from ecm_extract.infer.held import Held
from ecm_extract.link.code.pointed import is_null
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, Instance

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


class Origins:
    """Follows variables back to where they are given something."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._asked: set[tuple[Held, Env]] = set()
        self._members: set[tuple[Cls | None, str]] = set()

    def held(self, expr: Expr, env: Env) -> list[Held]:
        """Return what a variable may hold at a place, each with where it is evaluated; nothing where that is unknown.

        Of a member that the function at hand leaves alone it is what all methods leave it with; of a variable of a
        namespace what functions assign to it.
        """
        if not isinstance(expr, Name | Member):
            return []
        found = [(held, env) for way in self.folder.flow.ways(expr, env) for held in way]
        found = found or self._around(self.folder.flow.effects(env.func).key(expr), env)
        return list(dict.fromkeys(_placed(held, place) for held, place in found))

    def of(self, expr: Expr, env: Env) -> list[Held]:
        """Return the same, each as it was given: through loops, calls of methods, and callers that are known."""
        around, self._members = self._members, set()
        try:
            return list(dict.fromkeys(self._first(self.held(expr, env), env)))
        finally:
            self._members = around

    def makers(self, expr: Expr, env: Env) -> list[Bound] | None:
        """Return the expressions that may have made an object; None where one of them is not known.

        Those of a member are all that its class and its bases assign to it; of a variable of a namespace, which the
        function at hand finds as others left it, all that functions assign to it. No further run is needed: whoever
        gets an object may do things with it, and leaves it the one it is.
        """
        key = self.folder.flow.effects(env.func).key(expr)
        is_member = key.startswith(".") and key.count(".") == 1
        found = list(self._assigned_to_member(key[1:], env) if is_member else self._made(self.held(expr, env)))
        known = bool(found) and all(_is_object(held) for held in found)
        if isinstance(expr, Name) and not is_member and not known:
            found = [held for held, _ in self._of_namespace(expr.id, env)] or found
        made = [held for held in dict.fromkeys(found) if held.how != "made" and not _is_null(held)]
        makers = [Bound(held.expr, held.env) for held in made if held.how == "value" and held.expr and held.env]
        return makers if len(makers) == len(made) else None

    def _made(self, helds: Iterable[Held]) -> Iterator[Held]:
        """Yield what variables were given, whatever was done to it since."""
        pending, seen = list(helds), set[Held]()
        while pending:
            held = pending.pop(0)
            if held.how in {"value", "each"} or not (held.before or held.how in {"given", "shared"}):
                yield held
            before = self.folder.flow.decisions.ways(held.before) if held.how != "value" else ()
            pending += [each for each in before if each not in seen]
            seen.update(before)

    def _assigned_to_member(self, name: str, env: Env) -> Iterator[Held]:
        cls = env.this or env.func.cls
        made = env.made if env.made is not None and env.made.cls is cls else Instance(cls, {}, {}) if cls else None
        scope = self.folder.scope
        owner = scope.owner(name, cls, env) if cls is not None else None
        for entry in self.folder.program.ancestry(cls) if cls is not None else ():
            for func, at in scope.members(name, entry) if scope.declaring(name, entry) is owner else ():
                statement = func.fact.body[at]
                if self.folder.objects.runs(func, env.made):
                    args = _given_to(func, made, env)
                    place = Env(func, at, args, this=cls, made=made, depth=env.depth + 1)
                    yield Held("each" if statement.kind == "each" else "value", name, statement.value, place, at)

    def _first(self, helds: Iterable[Held], env: Env) -> Iterator[Held]:
        """Yield what was there before nothing was done that matters; nothing for what comes to itself in a circle."""
        pending = deque((held, held.env or env) for held in helds)
        seen: set[tuple[Held, Env]] = set()
        while pending:
            held, place = asked = pending.popleft()
            if asked in seen:
                continue
            if asked in self._asked or place.depth > MAX_DEPTH:
                self.folder.cuts += 1
                continue
            seen.add(asked)
            before = self._asking(held, place)
            if before is None:
                yield _placed(held, place)
            else:
                pending.extendleft((each, each.env or at) for each, at in reversed(before))

    def _asking(self, held: Held, env: Env) -> list[tuple[Held, Env]] | None:
        """Return what was there before; whoever asks for the same meanwhile asks in a circle."""
        self._asked.add((held, env))
        try:
            return self._before(held, env)
        finally:
            self._asked.discard((held, env))

    def _before(self, held: Held, env: Env) -> list[tuple[Held, Env]] | None:
        if held.how in {"looped", "handed", "reached", "entered"} or (held.how in {"given", "shared"} and held.before):
            return [(before, env) for before in self.folder.flow.decisions.ways(held.before)]
        if held.how in {"given", "shared"} and (env.this or env.func.cls, held.name) in self._members:
            self.folder.cuts += 1
            return []  # what all methods leave it with is among the answers
        if held.how in {"given", "shared"}:
            entered = self.folder.states.entered(held.name, env) if held.how == "given" else None
            return [(entered, env)] if entered is not None else self._around(held.name, env) or None
        left = self.folder.behind_calls.left(held, env) if held.how == "after" else None
        left = self.folder.behind_calls.out(held, env) if held.how == "out" else left
        return [(each, left[1]) for each in left[0]] if left is not None else None

    def _around(self, key: str, env: Env) -> list[tuple[Held, Env]]:
        """What a variable holds that the function at hand has not given anything."""
        cls = env.this or env.func.cls
        if key.startswith("."):
            if cls is None or key.count(".") > 1:
                return []
            self._members.add((cls, key))
            return self.folder.members.sources(key[1:], cls, env)
        given = self.folder.names.argument(key, env)
        if given is None:
            return list(self._assigned(key, env)) if "." not in key else []
        further = self.held(given.expr, given.env.deeper(env.depth + 1))
        return [(held, given.env) for held in further or [Held("value", key, given.expr, given.env)]]

    def _of_namespace(self, name: str, env: Env) -> Iterator[tuple[Held, Env]]:
        """What a variable of a namespace begins with, and all that functions assign to it."""
        if name in self.folder.flow.effects(env.func).own:
            return
        assigned = list(self._assigned(name, env))
        stated = self.folder.objects.file_scope.meant(name, env.func) if assigned else None
        if stated is not None and stated.constant.value is not None:
            place = self.folder.names.stated_at(stated.constant, stated.file, env)
            yield Held("value", name, stated.constant.value, place), place
        yield from assigned

    def _assigned(self, name: str, env: Env) -> Iterator[tuple[Held, Env]]:
        for entry in self.folder.objects.file_scope.definitions(name, env):
            place = Env(entry.func, entry.at, this=entry.func.cls, depth=env.depth + 1)
            yield Held("value", name, entry.statement.value, place, entry.at), place


def _given_to(func: Func, made: Instance | None, env: Env) -> Mapping[str, Bound]:
    """What a method gets: the one at hand what it got, the constructor that made the object what that was made with."""
    if func is env.func:
        return env.args
    return made.args if made is not None and made.maker is func else {}


def _is_object(held: Held) -> bool:
    """Tell whether a variable holds the value of an expression that is more than no object."""
    return held.how in {"value", "each"} and not _is_null(held)


def _is_null(held: Held) -> bool:
    return held.how == "value" and is_null(held.expr)


def _placed(held: Held, env: Env) -> Held:
    """The same with the place at which it is evaluated."""
    return held if held.env is not None else replace(held, env=env, settled={})
