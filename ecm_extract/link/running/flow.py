"""Runs of functions, each once for what it is called with, and what their variables hold at a place."""

from __future__ import annotations

import sys
from collections.abc import Collection, Hashable, Mapping, Sequence, Set
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr

from ecm_extract.infer.effects import Effects
from ecm_extract.infer.held import Held, State, joined_states
from ecm_extract.infer.interpreter import Interpreter
from ecm_extract.infer.judge import Kept
from ecm_extract.infer.outline import Outline
from ecm_extract.infer.places import as_written
from ecm_extract.infer.read_into import Reads
from ecm_extract.infer.rounds import Round
from ecm_extract.infer.routes import Fork, Verdict
from ecm_extract.infer.run import Run
from ecm_extract.link.code.naming_calls import leaves_arguments, searches
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.bounds import MAX_FRAMES, MAX_RECURSION, MAX_RUNNING, MAX_RUNS, MAX_WITHIN
from ecm_extract.link.running.decisions import Decisions
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env
from ecm_extract.link.running.exceptions import Exceptions
from ecm_extract.link.running.own_calls import OwnCalls
from ecm_extract.link.running.parameter_reads import read_into
from ecm_extract.link.running.run_keys import RunKeys
from ecm_extract.link.running.truths import Truths

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder
    from ecm_extract.link.running.changed_parameters import ChangedParameters
    from ecm_extract.link.running.lasting_states import LastingStates
    from ecm_extract.link.running.lent import Lent
    from ecm_extract.link.running.method_effects import MethodEffects


class Flow:
    """Runs functions; implements `infer.judge.Judge` with a folder."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        sys.setrecursionlimit(max(sys.getrecursionlimit(), MAX_FRAMES))
        self.keys = RunKeys()
        self._runs: dict[Hashable, tuple[Env, Run | None]] = {}
        self._running: dict[Hashable, Func] = {}
        self._meanwhile: dict[Hashable, tuple[Env, Run | None]] = {}
        self._within = self.refused = 0
        self._outlines: dict[Func, Outline] = {}
        self.own = OwnCalls(folder)
        self.exceptions = Exceptions(folder.program)
        self.truths = Truths(folder, self.outline)
        self.decisions = Decisions(folder, self.truths)

    @property
    def lasting(self) -> LastingStates:
        """Who follows variables that outlive a call."""
        return self.folder.lasting_states

    @property
    def lent(self) -> Lent:
        """Who follows what functions change which are handed to others."""
        return self.folder.lent

    @property
    def methods(self) -> MethodEffects:
        """Who knows what methods change."""
        return self.folder.methods

    @property
    def parameters(self) -> ChangedParameters:
        """Who knows what functions change that they are given."""
        return self.folder.methods.parameters

    @property
    def running(self) -> Collection[Func]:
        """The functions that are run right now, or of which a branch is decided."""
        return [*self._running.values(), *self.decisions.deciding]

    @property
    def is_busy(self) -> bool:
        """Whether anything is run or decided right now."""
        return bool(self._running) or bool(self.decisions.deciding)

    def forget(self) -> None:
        """Drop runs, since more is known of parameters now."""
        self._runs.clear()
        self.keys.forget()

    def run(self, env: Env, whole: bool = True) -> Run | None:
        """Return the run of the function at a place; None in a circle of questions, and after a fault.

        Args:
            env: the place.
            whole: whether its conditions are decided and its loops unrolled.
        """
        key = (self.keys.of(env), whole)
        known = self._runs.get(key) or self._meanwhile.get(key)
        if known is not None:
            return known[1]
        if not self._may_run(key, env):
            self.folder.cuts += 1
            return None
        if len(self._runs) > MAX_RUNS:
            self._runs = {asked: known for asked, known in self._runs.items() if not known[0].args}
        cuts = self.folder.cuts
        run = self._fresh(key, env, whole)
        whole = cuts == self.folder.cuts or not self.is_busy
        (self._runs if whole else self._meanwhile)[key] = (env, run)
        self.answered()
        return run

    def answered(self) -> None:
        """Forget what held only within a question, and what it cost, once it is answered: no other pays for it."""
        if not self.is_busy:
            self._meanwhile.clear()
            self.decisions.answered()
            self._within = 0

    def _fresh(self, key: Hashable, env: Env, whole: bool) -> Run | None:
        self._running[key], steps = env.func, self.folder.steps
        run: Run | None = None
        try:
            with self.folder.faults.of(env.func), steps.within(env.func):
                begun = env.entry(self.folder.begun_objects.state(env))
                run = Interpreter(begun, self, whole and not steps.is_spent(env.func)).result()
                steps.count(env.func, run.steps)
        finally:
            del self._running[key]
        return run

    def _may_run(self, key: Hashable, env: Env) -> bool:
        """Whether a run is neither asked for by itself, nor deeper than is followed."""
        self._within += key not in self._running
        bounded = env.depth > MAX_DEPTH or len(self._running) > MAX_RUNNING or self._within > MAX_WITHIN
        self.refused += bounded
        again = list(self._running.values()).count(env.func)
        return key not in self._running and not bounded and again < MAX_RECURSION

    def states(self, env: Env) -> Sequence[State]:
        """Return the states in which a place is reached; none where nothing is known of it."""
        if env.state is not None:
            return [env.state]
        run = self.run(env)
        if run is None:
            return []
        if env.at < len(env.func.fact.body):
            return self.decisions.live(run.states.get(env.at, ()))
        return [run.end] if run.end is not None else [state for found in run.states.values() for state in found[-1:]]

    def left(self, run: Run | None, key: str) -> tuple[Held, ...]:
        """Return what a run leaves a variable with; nothing where it left it alone, or never ends."""
        return self.decisions.ways(run.end.holds.get(key, ())) if run is not None and run.end is not None else ()

    def shown(self, run: Run, key: str) -> tuple[Held, ...]:
        """Return what others may find a variable with: while a run calls functions, and when it ends."""
        return (*self.decisions.ways(tuple(run.shown.get(key, ()))), *self.left(run, key))

    def returned(self, run: Run | None) -> list[tuple[int, State]]:
        """Return the `return` statements that a run may get to, with their states."""
        found = run.returns if run is not None else []
        return [(at, state) for at, state in found if self.decisions.is_live(state.route)]

    def reached(self, env: Env) -> Sequence[State]:
        """Return the states in which a place is reached, none where every run gets there."""
        return [] if self._is_certain(env) else self.states(env)

    def places(self, env: Env) -> list[Env]:
        """Return a place once for each state in which a run reaches it; itself where that is not known."""
        if self._is_certain(env):
            return [env]
        return [env.within(state, env.at) for state in self.states(env)] or [env]

    def naming(self, env: Env, given: Mapping[str, Bound]) -> Env:
        """Return a place at which more names are bound."""
        state = joined_states(self.states(env)) or State()
        held = {name: (Held("value", name, bound.expr, bound.env),) for name, bound in given.items()}
        return env.within(state.having(held), env.at)

    def is_reached(self, env: Env) -> bool:
        """Tell whether a run with these arguments can get to a place."""
        if self._is_certain(env):
            return True
        states = self.states(env)
        return not states or any(self.decisions.is_live(state.route) for state in states)

    def _is_certain(self, env: Env) -> bool:
        return env.state is None and env.at in self.outline(env.func).certain

    def ways(self, expr: Expr, env: Env, likely: bool = False) -> list[tuple[Held, ...]]:
        """Return what a variable may (likely: see `Decisions`) hold, by state; nothing where the function leaves it."""
        effects = self.effects(env.func)
        key = effects.key(expr)
        if not key:
            return []
        lasting = self.lasting.at(key, env)
        if lasting is not None:
            return lasting
        if env.state is None and not self._may_differ(key, env):
            return self._entered(key, env)
        states = self.decisions.likely(self.states(env)) if likely else self.states(env)
        found = [self.decisions.ways(state.holds.get(key, ()), likely) for state in states]
        if not any(found):
            if key in self.outline(env.func).escaped and "." in key[1:]:
                return [(Held("lost", key),)]  # a function within may give the field something any time
            changed = any(state.called for state in states) or (key.startswith(".") and not self.is_followed(key, env))
            return [] if changed else self._entered(key, env)
        shared = key.startswith(".") and key.count(".") == 1 and any(state.called for state in states)
        known = [ways or (Held("shared" if shared else "given", key),) for ways in found]
        return self.folder.unset.without(known, env.func)

    def _may_differ(self, key: str, env: Env) -> bool:
        """Whether a function, or a method that it calls on the same object, may give a variable something else."""
        changes = self.outline(env.func).changes
        if key in changes or key.partition(".")[0] in changes:
            return True  # of an object that the function has, methods and other names of it may change a field
        return key.startswith(".") and self.folder.methods.calls_own(env.func)

    def _entered(self, key: str, env: Env) -> list[tuple[Held, ...]]:
        """What a member holds that the function has left as its callers did, where they are known."""
        if env.outer is not None and self._is_shared(key, env):
            return self.ways(as_written(key), env.outer)
        held = self.folder.states.entered(key, env)
        return [(held,)] if held is not None else []

    def _is_shared(self, key: str, env: Env) -> bool:
        """Whether a variable is that of the object, or of the file, for a function and for the one that declares it."""
        own = key.startswith(".") and key.count(".") == 1
        return own or ("." not in key and key not in self._names_around(env))

    def _names_around(self, env: Env) -> Set[str]:
        around = self._names_around(env.outer) if env.outer is not None else frozenset()
        return self.effects(env.func).own | around

    def outline(self, func: Func) -> Outline:
        """Return what is known of a function before it runs."""
        known = self._outlines.get(func)
        if known is None:
            known = self._outlines[func] = Outline(func, self.reads(func), self.folder.nesting.inner(func), self)
        return known

    def effects(self, func: Func) -> Effects:
        """Return who knows the effects of a function's statements."""
        return self.outline(func).effects

    def is_bound_once(self, func: Func, key: str) -> bool:
        """Tell whether a function gives a variable one value and never changes it."""
        return self.outline(func).changes.get(key, 0) <= 1

    def truth(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds; None when that is not decided."""
        return self.truths.holds(test, env)

    def likely(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds as long as nobody sets a parameter; None when that is not decided."""
        return self.truths.verdict(test, env).likely

    def decided(self, fork: Fork) -> Verdict:
        """Tell whether what a branch asks holds, or something raises, and whether it likely does."""
        return self.decisions.of(fork)

    def text(self, expr: Expr, env: Env) -> str | None:
        """Return the text that an expression surely is; None where that is not known."""
        return self.truths.text(expr, env)

    def alike(self, one: Expr, other: Expr, env: Env, likely: bool = False) -> bool | None:
        """Tell whether two expressions (likely) have the same value; None when that is not decided."""
        return self.truths.alike(one, other, env, likely)

    def rounds(self, over: Expr, env: Env) -> list[Round] | None:
        """Return the rounds that a loop may have, in order; None where it may have others."""
        items = self.folder.lists.in_any_order(over, env)
        return self.folder.perhaps.items(over, env) if items is None else [Round(item) for item in items]

    def target(self, call: Call, func: Func, at: int) -> Func | None:
        """Return the function with a body that a call in a statement of a function means."""
        return self.folder.objects.run_by(call, Env(func, at, this=func.cls))

    def shown_part(self, call: Call, func: Func) -> Expr | None:
        """Return the part of an object of C++ that a method gives a reference to; None of other calls."""
        return self.folder.parts.shown(call, func)

    def has_setter(self, name: str, method: Func | None) -> bool:
        """Tell whether objects of Python have a property that a method sets: that of a method, None for any object."""
        return self.folder.python_fields.has_setter(name, method)

    def keeps(self, path: str) -> bool:
        """Tell whether a call that is written so is one of a client library, which leaves what it gets as it is."""
        return self.folder.reads.knows(last_name(path)) or leaves_arguments(path)

    def finds(self, path: str) -> bool:
        """Tell whether a call that is written so gives its last argument the name of a parameter that it looks for."""
        return searches(path)

    def is_of_library(self, name: str, func: Func) -> bool:
        """Tell whether a name that the file of a function of Python imports is of a module outside of the tree."""
        return bool(self.folder.program.outside(name, func.file))

    def shared_members(self, func: Func) -> Mapping[str, Set[str]]:
        """Return, for members of the object at hand, the others that each may be or consist of, by key."""
        return self.folder.states.kept_members.shared.of(func)

    def is_outside(self, name: str, func: Func) -> bool:
        """Tell whether a name in a method of C++, or in a lambda of one, means a variable of a namespace."""
        return self.folder.objects.file_scope.is_outside(name, func)

    def assigns_own_way(self, target: Expr | None, env: Env) -> bool:
        """Tell whether the class of an object of C++ says what an assignment to it does."""
        return self.folder.own_copies.is_assigned(target, env)

    def may_point(self, expr: Expr, env: Env) -> bool:
        """Tell whether what an expression of C++ is may be a pointer: its type says so, or is not known."""
        return not self.folder.objects.is_value(self.folder.objects.type_of(expr, env), env)

    def kept_arguments(self, call: Call, env: Env) -> Sequence[Kept]:
        """Return the arguments of a call of C++ to which some object keeps a reference or pointer."""
        return self.folder.kept_references.of(call, env)

    def changed_by_ending(self, func: Func) -> Set[str]:
        """Return the variables of C++, by key, that objects change when they end which a function makes."""
        return self.folder.ending.changed(func)

    def is_fixed(self, key: str, env: Env) -> bool:
        """Tell whether nobody gives a member anything else once the constructor gave it what it holds."""
        return self.folder.shifting.is_fixed(key, env)

    def is_followed(self, key: str, env: Env) -> bool:
        """Tell whether it is known who changes a member, or a variable outside of functions, or a part, and when."""
        if key.startswith("."):
            return not self.folder.changed_meanwhile.is_changed(key.split(".")[1], env)
        outside = self.folder.outside.is_followed(key.partition(".")[0], env.func)
        return outside or self.folder.lasting.named(key, env.func) is not None

    def runs_once(self, func: Func) -> bool:
        """Tell whether no program runs a function more than once."""
        return self.folder.runs_once.of(func)

    def reads(self, func: Func) -> Reads:
        """Return the parameters that a function reads into variables."""
        return read_into(self.folder.reads.all_written(func))

    def settle(self, held: Held) -> None:
        """Evaluate now, so that a long chain of changes needs no deep recursion later."""
        if held.env is not None:
            self.folder.held.values(held, held.env)
            self.folder.held.items(held, held.env)
