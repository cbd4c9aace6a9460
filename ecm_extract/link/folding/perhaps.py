"""What a list or a table has, and what it may have where branches that nobody decides add something.

`names.push_back("a"); if (asked) { names.push_back("b"); }` has `a` in every run, `b` in some; others it has in none.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name

from ecm_extract.infer.held import Held, Turn
from ecm_extract.infer.rounds import Round
from ecm_extract.link.folding.fold_tables import Entry
from ecm_extract.link.folding.reached_elements import reached
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

MAX_CHANGES: Final = 256
"""Changes of one variable that are followed."""
_STEPS: Final = frozenset({"changed", "stored", "reached"})
_APPENDS: Final = frozenset({"push_back", "emplace_back", "append"})
_KEYED: Final = frozenset({"insert", "emplace", "try_emplace", "insert_or_assign"})


class PerhapsEntry(NamedTuple):
    """An entry of a table, and whether every run has its key."""

    entry: Entry
    surely: bool


class _Step(NamedTuple):
    """What a variable begins with, or one change of it; whether every run has it, and where it is evaluated."""

    held: Held
    surely: bool
    env: Env


_Trail = dict[Held, _Step]


class PerhapsFolder:
    """Follows the changes of a variable along all routes that a run may take."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def items(self, expr: Expr | None, env: Env) -> list[Round] | None:
        """Return what a list may have, in order; None where something else may stand in it."""
        trail = self._trail(expr, env)
        found: list[Round] = []
        for step in trail.values() if trail is not None else ():
            more = self._items(step, found)
            if more is None:
                return None
            found = more
        return found if trail is not None else None

    def entries(self, expr: Expr | None, env: Env) -> list[PerhapsEntry] | None:
        """Return what a table may have; None where something else may stand in it."""
        trail = self._trail(expr, env)
        found: list[PerhapsEntry] = []
        for step in trail.values() if trail is not None else ():
            more = self._entries(step)
            if more is None:
                return None
            found += more
        return found if trail is not None else None

    def _items(self, step: _Step, before: list[Round]) -> list[Round] | None:
        """The elements of a list after one more step."""
        held, surely, env = step
        path = () if surely else self._asked(held)
        if held.how not in _STEPS:
            begun = self.folder.held.items(held, env) if not self._is_once(held, env) else None
            return None if begun is None else [*before, *(Round(item, path) for item in begun)]
        if held.how == "reached":
            return [Round(reached(each.item), each.path) for each in before]
        added = _added(held, env)
        return [*before, Round(added, path)] if added is not None else None

    def _asked(self, held: Held) -> tuple[Turn, ...]:
        """The branches that nobody decides on the way to a change."""
        state = held.env.state if held.env is not None else None
        return (self.folder.flow.decisions.turns(state.path) if state is not None else ()) or (Turn(),)

    def _is_once(self, held: Held, env: Env) -> bool:
        """Whether what a list begins with gives its elements to who asks first."""
        made = held.expr if env.func.file.language == "python" else None
        place = held.env if held.env is not None else env
        return isinstance(made, Call) and self.folder.iterators.is_once(made, place)

    def _entries(self, step: _Step) -> list[PerhapsEntry] | None:
        """The entries that one more step gives a table."""
        held, surely, env = step
        if held.how not in _STEPS:
            begun = self.folder.tables.held_entries(held, env)
            return None if begun is None else [PerhapsEntry(entry, surely) for entry in begun]
        if held.how == "reached":
            return []
        entry = _entered(held, env)
        return [PerhapsEntry(entry, surely)] if entry is not None else None

    # --- trails ------------------------------------------------------------------------------------------------

    def _trail(self, expr: Expr | None, env: Env) -> _Trail | None:
        """What was done to a variable, in order; None where that is not followed."""
        if not isinstance(expr, Name | Member):
            return None
        states = list(dict.fromkeys(self.folder.flow.ways(expr, env)))
        return self._of(states[0], env, {}) if len(states) == 1 else None

    def _of(self, ways: Sequence[Held], env: Env, known: dict[Held, _Trail | None]) -> _Trail | None:
        """The steps of all ways: those that not each of them has are not in every run."""
        trails = [self._of_one(held, env, known) for held in self.folder.flow.decisions.ways(tuple(ways))]
        if not trails:
            return None
        found: _Trail = {}
        for trail in trails:
            if trail is None:
                return None
            found = {**found, **{held: step for held, step in trail.items() if held not in found}}
        return {
            held: step._replace(surely=all(held in trail and trail[held].surely for trail in trails if trail))
            for held, step in found.items()
        }

    def _of_one(self, held: Held, env: Env, known: dict[Held, _Trail | None]) -> _Trail | None:
        if held not in known:
            known[held] = None  # asked for in a circle
            known[held] = self._walked(held, env, known)
        return known[held]

    def _walked(self, held: Held, env: Env, known: dict[Held, _Trail | None]) -> _Trail | None:
        if env.depth > MAX_DEPTH or len(known) > MAX_CHANGES or not self.folder.steps.take(env):
            self.folder.cuts += 1
            return None
        inner = held.env.deeper(env.depth + 1) if held.env is not None else env.deeper(env.depth + 1)
        if held.how in _STEPS:
            before = self._of(held.before, env, known)
            return {**before, held: _Step(held, True, inner)} if before is not None else None
        inside = self._inside(held, env, inner)
        if inside is not None:
            return self._of(inside[0], inside[1].deeper(env.depth + 1), known)
        return {held: _Step(held, True, env)}

    def _inside(self, held: Held, env: Env, inner: Env) -> tuple[tuple[Held, ...], Env] | None:
        """What a variable holds in the function that left it so, or that calls the one at hand; None of others."""
        if held.how == "after":
            return self.folder.behind_calls.left(held, inner)
        if held.how == "out":
            return self.folder.behind_calls.out(held, inner)
        if held.how == "entered":
            return held.before, inner
        if held.how not in {"given", "shared"}:
            return None
        entered = self.folder.states.entered(held.name, env)
        return ((entered,), env) if entered is not None else None


def _added(held: Held, env: Env) -> Bound | None:
    """What a call puts at the end of a list."""
    call = held.expr
    name = call.callee.name if isinstance(call, Call) and isinstance(call.callee, Member) else ""
    if held.how != "changed" or not isinstance(call, Call) or name not in _APPENDS or not call.args:
        return None
    if len(call.args) == 1:
        return Bound(call.args[0], env)
    return Bound(Items(call.args), env) if name == "emplace_back" else None


def _entered(held: Held, env: Env) -> Entry | None:
    """The key that a statement gives a table, with what it gives for it where the table had none."""
    if held.how == "stored":
        if held.expr is None or held.more is None:
            return None
        return Entry(Bound(held.expr, env), Bound(held.more, env))
    call = held.expr
    if not isinstance(call, Call) or not isinstance(call.callee, Member) or call.callee.name not in _KEYED:
        return None
    pair = call.args[0].items if len(call.args) == 1 and isinstance(call.args[0], Items) else call.args
    return Entry(Bound(pair[0], env), Bound(pair[1], env)) if len(pair) == 2 else None
