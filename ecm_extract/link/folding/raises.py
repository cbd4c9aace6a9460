"""Whether a statement raises, and what: proved where every value that it depends on is known, else open."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import Call, Comprehension, Expr, Lambda, Op
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.held import Held
from ecm_extract.infer.kinds import Kind
from ecm_extract.infer.raising import may_raise, raises_itself
from ecm_extract.infer.raising_calls import UNPACKED, Operation, unpacks
from ecm_extract.infer.routes import Raising
from ecm_extract.infer.run import Raised, Run
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.decorators import runs_at_once
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import children
from ecm_extract.link.folding.raise_checks import CHECKS, Asked
from ecm_extract.link.running.arguments import bind
from ecm_extract.link.running.env import MAX_DEPTH, Bound, Env, invocation_of

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_CHOOSING: Final = frozenset({"?:", "&&", "||"})


class Found(NamedTuple):
    """Whether something raises, None where that is open, and what it raises then; None where nobody knows.

    `made` is what makes the exception, where one thing does.
    """

    raises: bool | None
    kinds: frozenset[Kind] | None = None
    made: Bound | None = None


_OPEN: Final = Found(None)
_CALM: Final = Found(False)


class Raises:
    """Decides whether statements raise."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder

    def of(self, env: Env) -> Found:
        """Tell whether the statement of a place raises there."""
        statement = env.func.fact.body[env.at]
        open_ = False
        for found in self._in_order(statement, env):
            if found.raises:
                return Found(True, None, None) if open_ else found
            open_ = open_ or found.raises is None
        return _OPEN if open_ else _CALM

    def _in_order(self, statement: Statement, env: Env) -> Iterator[Found]:
        """What each part of a statement does, in the order in which they run."""
        if statement.value is not None and statement.type != "del":
            yield from self._parts(statement.value, env)
        if unpacks(statement):
            yield self._checked(UNPACKED, statement.value, env)
            return
        target = statement.target
        if isinstance(target, Op) and target.op == "[]" and statement.type != "del" and target.operands:
            stored = self._parts(target, env) if env.func.file.language == "python" else iter(())
            yield from (_OPEN if found.raises is None else _CALM for found in stored)
        elif target is not None and statement.type == "del":
            yield from self._parts(target, env)

    def _parts(self, expr: Expr, env: Env) -> Iterator[Found]:
        language = env.func.file.language
        if isinstance(expr, Lambda) or not may_raise(expr, language):
            return
        if isinstance(expr, Comprehension):
            yield _OPEN
            return
        if isinstance(expr, Op) and expr.op in _CHOOSING:
            yield from self._chosen(expr, env)
            return
        for part in children(expr):
            yield from self._parts(part, env)
        yield self._itself(expr, env)

    def _chosen(self, expr: Op, env: Env) -> Iterator[Found]:
        """Only what is asked first surely runs; of the rest what the answer leads to."""
        first, *rest = expr.operands
        yield from self._parts(first, env)
        for at, part in enumerate(rest):
            if may_raise(part, env.func.file.language):
                holds = self.folder.flow.truth(first, env)
                taken = None if holds is None or (at and expr.op != "?:") else self._is_taken(expr.op, at, holds)
                yield from self._parts(part, env) if taken else () if taken is False else (_OPEN,)

    def _is_taken(self, op: str, at: int, holds: bool) -> bool:
        return holds is (at == 0) if op == "?:" else holds is (op == "&&")

    def _itself(self, expr: Expr, env: Env) -> Found:
        """What an expression does apart from its parts."""
        language = env.func.file.language
        known = self.folder.flow.exceptions.operation(expr, env.func)
        found = self._checked(known, expr, env) if known is not None else _OPEN
        if found.raises is None and isinstance(expr, Call):
            found = self._called(expr, env)
        if found.raises is None and known is None and not raises_itself(expr, language):
            return _CALM
        return found

    def _checked(self, known: Operation, expr: Expr | None, env: Env) -> Found:
        if expr is None:
            return _OPEN
        verdict = CHECKS[known.when](Asked(self.folder, expr, env))
        kinds = [self.folder.flow.exceptions.kind(name, env.func) for name in known.kinds]
        if verdict.raises is None:
            return _OPEN
        kind = kinds[min(verdict.form, len(kinds) - 1)]
        return Found(verdict.raises, frozenset({kind}) if kind is not None else None)

    # --- functions of the tree -----------------------------------------------------------------------------

    def _called(self, call: Call, env: Env) -> Found:
        found = invocation_of(call, env)
        if self._makes_exception(found, env):
            return _CALM
        if (lacks := self.folder.enums.lacks(call, env)) is not None:
            kind = self.folder.flow.exceptions.kind("ValueError", env.func)
            return Found(lacks, frozenset({kind}) if kind is not None else None)
        callee = self.folder.returns.meant(found, env)
        if callee is None or not self._runs_at_once(callee) or self._has_others(callee):
            return _OPEN
        implied = callee.cls is not None and self.folder.flow.exceptions.always(callee)  # for others to override
        if callee.is_constructor or implied or self.folder.redefined.may_be(callee, found, env):
            return _OPEN
        run = self.folder.flow.run(self.folder.returns.entered(callee, found, bind(callee, found, env), env))
        return self._left(run) if run is not None and not run.cut else _OPEN

    def _makes_exception(self, call: Invocation, env: Env) -> bool:
        """Whether a call only makes an exception: no class of the tree that it is of has a constructor of its own."""
        program = self.folder.program
        cls = program.class_named(call.path, env.func.file, env.func.scope) if call.receiver is None else None
        kind = self.folder.flow.exceptions.kind(call.path, env.func) if cls is not None else None
        if cls is None or kind is None or not kind.whole:
            return False
        return not any(method.is_constructor for entry in program.ancestry(cls) for method in entry.methods)

    def _runs_at_once(self, callee: Func) -> bool:
        """Whether a call runs the body, and nothing around it that may handle what it raises."""
        has_body = bool(callee.fact.body or callee.fact.flow)
        waits = not {"generator", "coroutine"}.isdisjoint(callee.fact.traits)
        plain = callee.file.language == "cpp" or runs_at_once(callee)
        return has_body and not waits and plain

    def _has_others(self, callee: Func) -> bool:
        """Whether a class that derives from that of a method has one of its own."""
        if callee.cls is None:
            return False
        derived = self.folder.program.derived(callee.cls)
        return any(method.fact.name == callee.fact.name for cls in derived for method in cls.methods)

    def _left(self, run: Run) -> Found:
        """What a function raises that never ends otherwise."""
        live = self.folder.flow.decisions.is_live
        raised = [each for each in run.raised if live(each.state.route)]
        if run.end is not None and live(run.end.route):
            return _OPEN if raised or run.risky else _CALM
        if not raised:
            return _OPEN
        kinds = [self._kinds(each) for each in raised]
        known = [each for each in kinds if each is not None]
        whole = len(known) == len(kinds) and not run.risky
        made = self.made(raised[0].made) if whole and len(raised) == 1 else None
        return Found(True, frozenset().union(*known) if whole else None, made)

    def made(self, held: Held | None) -> Bound | None:
        """Return what makes an exception, which a statement raises; None where that is not known."""
        if held is None or held.env is None:
            return None
        if held.expr is not None:
            return Bound(held.expr, held.env)
        return self.of(held.env).made if held.env.depth <= MAX_DEPTH else None

    def _kinds(self, raised: Raised) -> frozenset[Kind] | None:
        if isinstance(raised.what, Raising):
            return raised.what.kinds
        return frozenset({raised.what}) if raised.what is not None else None
