"""What variables hold that outlive a call (see `lasting`): by the calls that led to a place, in their order."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence, Set
from itertools import pairwise
from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Call, Expr, Op

from ecm_extract.infer.held import MAX_WAYS, Held, State
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import calls_in, children
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, invocation_of
from ecm_extract.link.running.lasting import Lasting
from ecm_extract.link.running.runs_once import is_main

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

Ways = tuple[Held, ...]


class LastingStates:
    """Follows such variables from call to call."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._asked: set[Hashable] = set()

    def at(self, key: str, env: Env) -> list[Ways] | None:
        """Return what a variable may hold at a place, for each state; None where that is not known.

        Args:
            key: the variable, as the function at hand knows it.
            env: the place.
        """
        variable = self.folder.lasting.named(key, env.func)
        if variable is None:
            return None
        ways = None if variable.changed_by(env.func, env.at) else self._at(variable, env)
        return ways or [(Held("shared", key),)]  # what is changed while it is read is told by nobody

    def entered(self, key: str, env: Env) -> Ways | None:
        """Return what a variable holds when the function at a place begins; None where that is not known."""
        variable = self.folder.lasting.named(key, env.func)
        return self._entered(variable, env) if variable is not None else None

    def keys(self, func: Func, at: int) -> Set[str]:
        """Return the variables, by key, that the calls of a statement may change."""
        return self.folder.lasting.changed_at(func, at)

    def changed(self, env: Env, state: State) -> Mapping[str, Ways]:
        """Return what the calls of a statement leave variables with that they may change, by their keys."""
        found: dict[str, Ways] = {}
        for variable in self.folder.lasting.of(env.func):
            calls = variable.changed_by(env.func, env.at)
            if calls:
                key = variable.key_in(env.func)
                before = state.holds.get(key) or (Held("given", key, env=env),)
                found[key] = self._after_all(variable, calls, before, env) or (Held("lost", key, before=before),)
        return found

    def left(self, held: Held, env: Env) -> tuple[Ways, Env] | None:
        """Return what a called function leaves a variable with, and the place to evaluate it at."""
        variable = self.folder.lasting.named(held.name, env.func)
        if variable is None or not isinstance(held.expr, Call):
            return None
        call = invocation_of(held.expr, env)
        callee = self.folder.returns.meant(call, env)
        if callee is None or self.folder.redefined.may_be(callee, call, env):
            return None
        inner = self.folder.returns.entered(callee, call, bind(callee, call, env), env)
        if callee not in variable.changing:
            return held.before, env
        flow = self.folder.flow
        run = flow.run(inner)
        if run is None or run.end is None:
            return None
        ways = flow.left(run, variable.key_in(callee))
        return (ways, inner) if ways else (held.before, env)

    # --- places --------------------------------------------------------------------------------------------

    def _at(self, variable: Lasting, env: Env) -> list[Ways] | None:
        flow = self.folder.flow
        key = variable.key_in(env.func)
        found: list[Ways] = []
        for state in flow.states(env):
            ways = flow.decisions.ways(state.holds.get(key, ())) or self._entered(variable, env)
            if ways is None:
                return None
            found.append(ways)
        return found or None

    def _entered(self, variable: Lasting, env: Env) -> Ways | None:
        if is_main(env.func):
            return (variable.first,)
        asked = (variable, self.folder.flow.keys.of(env))
        came = env.call or self._only_call(env.func)
        if came is None or asked in self._asked or env.depth > MAX_DEPTH:
            self.folder.cuts += came is not None
            return None
        self._asked.add(asked)
        try:
            return self._before_call(variable, came, env)
        finally:
            self._asked.discard(asked)

    def _only_call(self, func: Func) -> Bound | None:
        """The one call of a function that programs run once."""
        made = self.folder.runs_once.only_call(func)
        if made is None:
            return None
        return self._call_at(made, Env(made.func, made.at, this=self.folder.nesting.object_of(made.func)))

    def led(self, callee: Func, call: Invocation, env: Env) -> Bound | None:
        """Return the call that leads to a function, with its place, where what that does depends on it."""
        return self._call_at(call, env) if self.folder.lasting.is_concerned(callee) else None

    def _call_at(self, made: Invocation, env: Env) -> Bound | None:
        """The call at a place by what it is seen as; None where several are alike."""
        calls = env.func.calls[env.at] if env.at < len(env.func.calls) else ()
        alike = (call for call in calls if call.args == made.args)
        found = [call for call in alike if invocation_of(call, env).path == made.path]
        found = self._perhaps_made(found, env) if len(found) > 1 else found
        return Bound(found[0], env) if len(found) == 1 else None

    def _before_call(self, variable: Lasting, came: Bound, env: Env) -> Ways | None:
        """What a variable holds where a call begins: at its statement, after those that make its arguments."""
        place, call = came.env.deeper(env.depth + 1), came.expr
        changing = self._perhaps_made(variable.changed_by(place.func, place.at), place)
        within = [each for each in changing if each is not call and _is_within(each, call)]
        outer = [each for each in changing if each is call or _is_within(call, each)]
        ways = self._at(variable, place)
        if ways is None or len(within) + len(outer) < len(changing):
            return None
        key = variable.key_in(place.func)
        all_ways = tuple(dict.fromkeys(held for each in ways for held in each))
        if len(all_ways) > MAX_WAYS:
            return None
        before = (Held("entered", key, env=place, before=all_ways),)
        return self._after_all(variable, within, before, place) if within else before

    # --- calls ---------------------------------------------------------------------------------------------

    def _after_all(self, variable: Lasting, calls: Sequence[Call], before: Ways, env: Env) -> Ways | None:
        """What calls of one statement leave; None where their order is not known."""
        made = self._perhaps_made(calls, env)
        if not all(_is_within(one, other) for one, other in pairwise(made)):
            return None
        ways: Ways | None = before
        for call in made:
            ways = self._after(variable.key_in(env.func), call, ways, env) if ways is not None else None
        return ways

    def _perhaps_made(self, calls: Sequence[Call], env: Env) -> list[Call]:
        """The calls of a statement without those on the sides of choices that are not taken."""
        value = env.func.fact.body[env.at].value
        return [call for call in calls if self._happens(call, value, env) is not False]

    def _after(self, key: str, call: Call, before: Ways, env: Env) -> Ways | None:
        held = Held("after", key, call, env, env.at, before=before)
        ways = (held,) if self._happens(call, env.func.fact.body[env.at].value, env) else (*before, held)
        return ways if len(ways) <= MAX_WAYS else None

    def _happens(self, call: Call, expr: Expr | None, env: Env) -> bool | None:
        """Whether a call within an expression runs; None where a choice that decides it is not decided."""
        if expr is None or expr is call:
            return True
        part = next((part for part in children(expr) if part is call or _is_within(call, part)), None)
        if not isinstance(expr, Op) or expr.op not in {"?:", "&&", "||"} or part is expr.operands[0]:
            return self._happens(call, part, env)
        holds = self.folder.flow.truth(expr.operands[0], env)
        wanted = part is expr.operands[1] if expr.op == "?:" else expr.op == "&&"
        return None if holds is None else self._happens(call, part, env) if holds is wanted else False


def _is_within(call: Expr, other: Expr) -> bool:
    """Whether a call is a part of an expression."""
    return any(call is each for each in calls_in(other)) and call is not other
