"""Runs of functions, each once for what it is called with, and what their variables hold at a place."""

from __future__ import annotations

import sys
from collections import defaultdict
from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Name, Op, Opaque

from ecm_extract.infer.compute import UNKNOWN, operate, truth
from ecm_extract.infer.effects import Effects
from ecm_extract.infer.held import Held, State
from ecm_extract.infer.interpreter import Interpreter, Run
from ecm_extract.infer.places import own_names
from ecm_extract.link.env import MAX_DEPTH, Bound, Env, invocation_of
from ecm_extract.link.units import File, Func
from ecm_extract.link.values import Value, data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.fold import Folder

MAX_RUNS = 500
"""Runs with arguments that are remembered."""
MAX_FRAMES = 6_000
"""Calls within calls: our own bounds (MAX_DEPTH, MAX_RUNNING, MAX_NESTING) end before that, the default does not."""
MAX_RUNNING = 8
"""Runs within runs: what a function is called with may be what another function does."""
_Key = tuple[int, int, int, int]


class Flow:
    """Runs functions; implements `infer.interpreter.Judge` with a folder."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        sys.setrecursionlimit(max(sys.getrecursionlimit(), MAX_FRAMES))
        self._runs: dict[_Key, tuple[Env, Run]] = {}
        self._running: set[_Key] = set()
        self._effects: dict[int, Effects] = {}
        self._changes: dict[tuple[int, str], bool] = {}
        self._inner: dict[int, Mapping[str, list[Func]]] = {}
        self._touched: dict[int, set[str]] = {}
        self._again: dict[int, Mapping[str, int]] = {}

    def forget(self) -> None:
        """Drop runs, since more is known of parameters now."""
        self._runs.clear()

    # --- runs --------------------------------------------------------------------------------------------

    def run(self, env: Env) -> Run | None:
        """Return the run of the function at a place; None while it is running: who asks then asks in a circle."""
        key = _key(env)
        known = self._runs.get(key)
        if known is not None:
            return known[1]
        if key in self._running or env.depth > MAX_DEPTH or len(self._running) > MAX_RUNNING:
            self.folder.cuts += 1
            return None
        self._running.add(key)
        if len(self._runs) > MAX_RUNS:
            self._runs.clear()
        entry = Env(env.func, 0, env.args, env.types, env.this, env.made, env.depth + 1, State(), env.outer)
        try:
            with self.folder.steps.apart():
                run = Interpreter(entry, self).result()
        finally:
            self._running.discard(key)
        self._runs[key] = (env, run)
        return run

    def states(self, env: Env) -> list[State]:
        """Return the states in which a place is reached; none where nothing is known of it."""
        if env.state is not None:
            return [env.state]
        run = self.run(env)
        if run is None:
            return []
        if env.at < len(env.func.fact.body):
            return run.at(env.at)
        return [run.end] if run.end is not None else [state for found in run.states.values() for state in found[-1:]]

    def places(self, env: Env) -> list[Env]:
        """Return a place once for each state in which a run reaches it; itself where that is not known."""
        states = self.states(env)
        return [env.within(state, env.at) for state in states] or [env]

    def is_reached(self, env: Env) -> bool:
        """Tell whether a run with these arguments can get to a place."""
        states = self.states(env)
        return not states or any(state.live for state in states)

    def ways(self, expr: Expr, env: Env) -> list[tuple[Held, ...]]:
        """Return what a variable may hold at a place, for each state; nothing where the function leaves it alone."""
        effects = self.effects(env.func)
        key = effects.key(expr)
        if not key:
            return []
        states = self.states(env)
        found = [state.holds.get(key, ()) for state in states]
        if not any(found):
            return []
        shared = key.startswith(".") and key.count(".") == 1 and any(state.called for state in states)
        return [ways or (Held("shared" if shared else "given", key),) for ways in found]

    def effects(self, func: Func) -> Effects:
        """Return who knows the effects of a function's statements."""
        known = self._effects.get(id(func))
        if known is None:
            own = own_names(func.fact, func.file.language == "python")
            known = self._effects[id(func)] = Effects(func, own, self)
        return known

    def is_bound_once(self, func: Func, key: str) -> bool:
        """Tell whether a function gives a variable one value and never changes it."""
        known = self._again.get(id(func))
        if known is None:
            counts: dict[str, int] = defaultdict(int)
            effects, env = self.effects(func), Env(func)
            for at, statement in enumerate(func.fact.body):
                target = effects.key(statement.target) or effects.root(statement.target)
                counts[target] += statement.kind != "do"
                for effect in effects.of(at, env):
                    counts[effect.key] += 1
            known = self._again[id(func)] = counts
        return known.get(key, 0) <= 1

    def touched(self, func: Func) -> Collection[str]:
        """Return the keys of the variables that a function may change, its own among them."""
        known = self._touched.get(id(func))
        if known is None:
            effects, env = self.effects(func), Env(func)
            known = {effect.key for at in range(len(func.fact.body)) for effect in effects.of(at, env)}
            known |= {effects.root(statement.target) for statement in func.fact.body if statement.kind == "set"}
            self._touched[id(func)] = known
        return known

    # --- what a run asks ---------------------------------------------------------------------------------

    def truth(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds; None when that is not decided."""
        if isinstance(test, Opaque):
            return None
        if isinstance(test, Op) and test.op == "!":
            inner = self.truth(test.operands[0], env)
            return None if inner is None else not inner
        if isinstance(test, Op) and test.op in {"&&", "||"}:
            return self._all_of(test, env)
        python = env.func.file.language == "python"
        values = self.folder.fold(test, env)
        found = {truth(data_in(value), python) if is_proved(value) else None for value in values}
        if found == {None} and python:
            items = self.folder.lists.items(test, env)
            return None if items is None else bool(items)
        return found.pop() if len(found) == 1 else None

    def _all_of(self, test: Op, env: Env) -> bool | None:
        ends = test.op == "||"
        undecided = False
        for operand in test.operands:
            holds = self.truth(operand, env)
            if holds is ends:
                return None if undecided else ends
            undecided = undecided or holds is None
        return None if undecided else not ends

    def alike(self, one: Expr, other: Expr, env: Env) -> bool | None:
        """Tell whether two expressions have the same value; None when that is not decided."""
        python = env.func.file.language == "python"
        pairs = [(a, b) for a in self.folder.fold(one, env) for b in self.folder.fold(other, env)]
        found = {_same(a, b, python) for a, b in pairs}
        return found.pop() if len(found) == 1 else None

    def rounds(self, over: Expr, env: Env) -> list[Bound] | None:
        """Return what a loop is over, each element once; None when not all of it is known."""
        return self.folder.lists.items(over, env)

    def target(self, call: Call, env: Env) -> Func | None:
        """Return the function with a body that a call means."""
        return self.folder.objects.callee(invocation_of(call, env), env)

    def keeps(self, name: str) -> bool:
        """Tell whether a call of that name is one of a client library, which leaves what it gets as it is."""
        return self.folder.reads.knows(name)

    def changes(self, func: Func, name: str) -> bool:
        """Tell whether a function may change what its parameter consists of."""
        key = (id(func), name)
        known = self._changes.get(key)
        if known is None:
            self._changes[key] = True  # who asks in a circle is told that it may
            known = self._changes[key] = self._may_change(func, name)
        return known

    def _may_change(self, func: Func, name: str) -> bool:
        effects, env = self.effects(func), Env(func)
        for at, statement in enumerate(func.fact.body):
            if any(effect.key == name for effect in effects.of(at, env)):
                return True
            within = effects.root(statement.target) == name and effects.key(statement.target) != name
            grown = effects.key(statement.target) == name and statement.type.endswith("=")
            kept = statement.kind in {"set", "return"} and effects.key(statement.value) == name
            if within or grown or kept:
                return True
        return False

    def is_own(self, call: Call, env: Env) -> bool:
        """Tell whether a call may run a function of the tree."""
        last = invocation_of(call, env).last
        return bool(last) and bool(self.folder.program.seen_functions(last, env.func.file))

    def reads(self, func: Func) -> Mapping[int, Sequence[tuple[Expr, Expr, Expr | None]]]:
        """Return statement -> (variable, name, default) of the parameters that a function reads into variables."""
        found: dict[int, list[tuple[Expr, Expr, Expr | None]]] = defaultdict(list)
        for target, entries in self.folder.reads.all_written(func).items():
            for at, name, default in entries:
                if not target.startswith("."):
                    found[at].append((Name(target), name, default))
        return found

    def inner(self, func: Func) -> Sequence[Func]:
        """Return the functions that are declared within a function."""
        by_scope = self._inside(func.file)
        if func.fact.name == "<module>":
            return [entry for group in by_scope.values() for entry in group if entry.fact.shared]
        scope = f"{func.fact.scope}::{func.fact.name}" if func.fact.scope else func.fact.name
        return by_scope.get(scope, ())

    def enclosing(self, func: Func) -> Func | None:
        """Return the function that one is declared in."""
        head, _, last = func.fact.scope.rpartition("::")
        for other in self.folder.program.functions_in(func.file):
            if other.fact.name == last and other.fact.scope == head and other.fact.body:
                return other
        return None

    def _inside(self, file: File) -> Mapping[str, list[Func]]:
        known = self._inner.get(id(file))
        if known is None:
            known = self._inner[id(file)] = defaultdict(list)
            for func in self.folder.program.functions_in(file):
                known[func.fact.scope].append(func)
        return known

    def settle(self, held: Held) -> None:
        """Evaluate now, so that a long chain of changes needs no deep recursion later."""
        if held.env is not None:
            self.folder.held.values(held, held.env)
            self.folder.held.items(held, held.env)


def _key(env: Env) -> _Key:
    made = env.made
    trivial = made is None or not (made.args or made.types or made.maker)
    this = env.this or env.func.cls
    return id(env.func), id(env.args) if env.args else 0, id(this), (0 if trivial else id(made)) ^ id(env.outer)


def _same(one: Value, other: Value, python: bool) -> bool | None:
    if not (is_proved(one) and is_proved(other)):
        return None
    found = operate("==", data_in(one), data_in(other), python)
    return None if found is UNKNOWN else bool(found)
