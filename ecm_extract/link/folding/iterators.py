"""What Python gives one by one, and only once: generators of the tree, `map`, `zip`, what itertools makes.

docs.python.org: Language reference, "Yield expressions"; Glossary, "iterator".
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Number, Table, Text
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Loop, statements, steps

from ecm_extract.infer.held import Held
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.decorators import runs_at_once
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import Bound, Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ONCE: Final = frozenset({"map", "zip", "filter", "reversed", "enumerate", "iter"})


class Iterators:
    """Lists what is given one by one, where it is given to one who asks for all of it."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def yielded(self, callee: Func, call: Invocation, env: Env) -> list[Bound] | None:
        """Return what a generator yields, in order; None where that is not decided, or may change in between."""
        if not runs_at_once(callee) or {"coroutine", "receiving"}.intersection(callee.fact.traits):
            return None
        this = self.folder.returns.object_at(callee, call, env)
        if (
            self._shares(callee)
            or self.folder.methods.depends(callee, this)
            or not all(self._is_kept(arg, env) for arg in _given(call))
        ):
            return None
        place = self.folder.returns.entered(callee, call, bind(callee, call, env), env)
        run = self.folder.flow.run(place)
        if run is None or run.cut:
            return None
        live = [(at, state) for at, state in run.yields if self.folder.flow.decisions.is_live(state.route)]
        if any(self.folder.flow.decisions.turns(state.path) for _, state in live):
            return None
        parts = [self._part(callee.fact.body[at], place.within(state, at)) for at, state in live]
        known = [part for part in parts if part is not None]
        return [each for part in known for each in part] if len(known) == len(parts) else None

    def _part(self, statement: Statement, place: Env) -> list[Bound] | None:
        """What one statement yields: one thing, or the elements of a list."""
        if statement.value is None or statement.type == "yield":
            return [Bound(statement.value, place)] if statement.value is not None else None
        return self.folder.lists.items(statement.value, place)

    def _shares(self, callee: Func) -> bool:
        """Whether a generator has variables in common with a function around it, which that may change in between."""
        outer = self.folder.nesting.enclosing(callee)
        flow = self.folder.flow
        names = self.folder.shifting.names(callee) & flow.effects(outer).own if outer is not None else ()
        return bool(callee.fact.shared) or any(not flow.is_bound_once(outer, name) for name in names if outer)

    def _is_kept(self, arg: Expr, env: Env) -> bool:
        """Whether who asks a generator for its values does not change what it gave that to begin with."""
        if isinstance(arg, Text | Number | Items | Table):
            return True
        key = self.folder.flow.effects(env.func).key(arg)
        return bool(key) and self.folder.flow.is_bound_once(env.func, key)

    def of_held(self, expr: Name | Member, ways: list[tuple[Held, ...]], env: Env) -> list[Bound] | None:
        """Return the elements of what a variable holds, unless somebody may have had them before."""
        spent = env.func.file.language == "python" and any(
            held.how == "value" and held.env is not None and self._is_spent(expr, held.expr, held.at, held.env, env)
            for way in ways
            for held in way
        )
        return None if spent else self.folder.held.items_of(ways, env)

    def of_given(self, expr: Name | Member, given: Bound, env: Env) -> list[Bound] | None:
        """Return the elements of what a caller gives, unless somebody may have had them before."""
        if env.func.file.language == "python" and self._is_spent(expr, given.expr, -1, given.env, env):
            return None
        return self.folder.lists.items(given.expr, given.env.deeper(env.depth + 1))

    def _is_spent(self, expr: Name | Member, made: Expr | None, at: int, place: Env, env: Env) -> bool:
        """Whether a variable holds what is given only once, and it is not asked for in one place only."""
        if not isinstance(made, Call) or not self.is_once(made, place):
            return False
        func = env.func
        named = [
            each
            for each, statement in enumerate(func.fact.body)
            for part, _ in expressions(statement)
            if part == expr and statement.target is not part
        ]
        asked = [each for each in named if each != at]
        loops = [step for step in steps(func.fact.flow) if isinstance(step, Loop)]
        rounds = any(
            each in statements(loop.body) and at not in statements(loop.body) for loop in loops for each in asked
        )
        return not isinstance(expr, Name) or len(asked) > 1 or rounds or bool(self.folder.nesting.inner(func))

    def is_once(self, made: Call, env: Env) -> bool:
        """Tell whether a call makes what gives each of its elements only once."""
        call = invocation_of(made, env)
        if call.receiver is None and (call.path in _ONCE or call.path.startswith("itertools.")):
            return True
        callee = self.folder.returns.meant(call, env)
        return callee is not None and "generator" in callee.fact.traits


def _given(call: Invocation) -> Iterable[Expr]:
    return (*call.args, *(value for _, value in call.keywords))
