"""Functions that are lent: handed to a function which only calls them, and changes through them what it cannot name.

`visited(names, [&](const auto & name) { text += name; });` changes `text` once for each round in `visited`. While that
runs, its states have such a variable by a key of its own, and each call of the parameter changes what it holds.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Name

from ecm_extract.infer.held import Held, State, joined_states
from ecm_extract.infer.inner import function_named
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import children, perhaps_called
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_MARK: Final = "^"
"""Begins the key of a variable of who lent a function, in the function that calls it."""
_LOST: Final = "lost"


class Lent:
    """Tells which functions are lent, and what they change where they are called."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._calling: dict[tuple[Func, str], bool] = {}

    # --- who lends -------------------------------------------------------------------------------------------

    def is_lent(self, call: Call, func: Func, index: int) -> bool:
        """Tell whether a function of the tree does nothing with an argument of a call in another one but call it."""
        callee = self.folder.flow.target(call, func, len(func.fact.body))
        if callee is None or index >= len(callee.params) or not self.is_one(callee):
            return False
        key = (callee, callee.params[index].name)
        if key not in self._calling:
            self._calling[key] = _only_calls(*key) and not self._is_seen_inside(*key)
        return self._calling[key]

    def is_one(self, callee: Func) -> bool:
        """Tell whether no other function can run in place of one."""
        derived = self.folder.program.derived(callee.cls) if callee.cls is not None else ()
        others = {method.fact.name for entry in derived for method in entry.methods}
        same = any(each.fact.body for each in callee.siblings() if each is not callee)
        return callee.fact.name not in others and not same and not callee.fact.decorators

    def _is_seen_inside(self, func: Func, name: str) -> bool:
        return any(name in self.folder.shifting.names(inner) for inner in self.folder.nesting.inner(func))

    # --- what they change ------------------------------------------------------------------------------------

    def keys(self, env: Env, at: int) -> Set[str]:
        """Return the variables, by key, that a statement changes by calling what its function was lent."""
        lent = self._closures(env) if any(self._calls(env, at, env.args)) else {}
        return frozenset(key for _, name in self._calls(env, at, lent) for key in lent[name][1])

    def changed(self, env: Env, state: State) -> Mapping[str, tuple[Held, ...]]:
        """Return what such calls of a statement leave these variables with, by key."""
        lent = self._closures(env) if any(self._calls(env, env.at, env.args)) else {}
        calls = list(self._calls(env, env.at, lent))
        perhaps = set(perhaps_called(env.func.fact.body[env.at].value)) if calls else set()
        found: dict[str, tuple[Held, ...]] = {}
        for call, name in calls:
            for key in lent[name][1]:
                before = state.holds.get(key) or (Held("given", key, env=env),)
                known = len(calls) == 1 and call not in perhaps
                found[key] = (Held("after" if known else _LOST, key, call, env, env.at, before=before),)
        return found

    def _calls(self, env: Env, at: int, lent: Mapping[str, object]) -> Iterator[tuple[Call, str]]:
        for call in env.func.calls[at]:
            if isinstance(call.callee, Name) and call.callee.id in lent:
                yield call, call.callee.id

    def _closures(self, env: Env) -> Mapping[str, tuple[Func, Set[str]]]:
        """Parameter -> the function that it was lent, with the keys of what that changes."""
        found: dict[str, tuple[Func, Set[str]]] = {}
        for name, bound in env.args.items():
            func = self._function(bound)
            changes = self.folder.flow.outline(bound.env.func).captured.get(func, ()) if func is not None else ()
            if func is not None and changes:
                found[name] = (func, frozenset(f"{_MARK}{key}" for key in changes))
        return found

    def _function(self, bound: Bound) -> Func | None:
        """The function within the one that hands it on which an argument is."""
        name = function_named(bound.expr)
        inner = self.folder.nesting.inner(bound.env.func) if name else ()
        return next((func for func in inner if func.fact.name == name), None)

    # --- what they leave -------------------------------------------------------------------------------------

    def left(self, held: Held, env: Env) -> tuple[tuple[Held, ...], Env] | None:
        """Return what a call leaves such a variable with, and the place to evaluate it at; None of other variables."""
        call = held.expr
        if not isinstance(call, Call):
            return None
        marked = held.name.startswith(_MARK)
        invocation = invocation_of(call, env)
        callee = self.folder.returns.meant(invocation, env)
        lending = callee is not None and not marked and callee not in self.folder.flow.outline(env.func).captured
        if callee is None or not (marked or (lending and self._lends(call, env.func))):
            return None
        inner = self.folder.returns.entered(callee, invocation, bind(callee, invocation, env), env)
        run = self.folder.flow.run(inner)
        if run is None or run.end is None:
            return ((Held(_LOST, held.name),), env)
        ways = self.folder.flow.left(run, held.name.removeprefix(_MARK) if marked else f"{_MARK}{held.name}")
        return (ways, inner) if ways else (held.before, env)

    def _lends(self, call: Call, func: Func) -> bool:
        names = {inner.fact.name for inner in self.folder.flow.outline(func).captured}
        return any(function_named(arg) in names for arg in call.args)

    def around(self, key: str, env: Env) -> tuple[Expr, Env] | None:
        """Return a variable that a function sees of who lends it, or declares it; None of other variables."""
        if not key.startswith(_MARK):
            place = env.outer if "." not in key and key not in self.folder.flow.effects(env.func).own else None
            return (Name(key), place) if place is not None else None
        for name, (_, keys) in self._closures(env).items():
            if key in keys:
                return Name(key.removeprefix(_MARK)), env.args[name].env
        return None

    def place(self, func: Func, place: Env, env: Env) -> Env:
        """Return where a lent function was made, with what its calls so far have left its variables with.

        Args:
            func: the function.
            place: where it was handed on.
            env: where it is called.
        """
        keys = next((keys for each, keys in self._closures(env).values() if each is func), ())
        flow = self.folder.flow
        state = joined_states(flow.states(env)) if keys else None
        held = {key.removeprefix(_MARK): state.holds[key] for key in keys if key in state.holds} if state else {}
        if not held:
            return place
        around = joined_states(flow.states(place))
        if around is None:
            held = {key: (Held(_LOST, key),) for key in held}
        return place.within((around or State()).having(held), place.at)


def _only_calls(func: Func, name: str) -> bool:
    """Whether a function does nothing with a parameter but call it, where it stands."""
    for statement in func.fact.body:
        if statement.target == Name(name):
            return False
        for expr in (statement.target, statement.value):
            if expr is not None and any(_gives(expr, name, statement.deferred)):
                return False
    return True


def _gives(expr: Expr, name: str, later: bool) -> Iterator[bool]:
    """Yield for each time that an expression does anything else with a variable than call it at once."""
    if expr == Name(name):
        yield True
    called = isinstance(expr, Call) and expr.callee == Name(name) and not later
    parts = children(expr)
    for part in parts[1:] if called else parts:
        yield from _gives(part, name, later)
