"""Statements that no run gets to: behind what leaves the function, and under conditions that nobody can meet.

Only what the source fixes counts: literals, constants that nobody assigns, variables that hold nothing else, and
members that nobody gives anything. Values of what others may assign prove nothing here, however well they are known.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set
from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import THIS, Constant, Expr, Member, Name, Number, Op, Text
from ecm_parsers.source.flow import Block, Branch, Leave, Loop, Step, Switch, blocks, statements, steps

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.given_once import GivenOnce
from ecm_extract.link.running.never_set import NeverSet

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_ENDING: Final = {"&&": False, "||": True}
"""What one operand of an operator decides by itself, whatever the others are."""

_CHAIN: Final = Constant("true")
"""The subject of a switch that is a chain of `else if`."""
_FIXED: Final = frozenset({"constexpr", "define", "enum", "const"})


class DeadCode:
    """Finds them in each function, once."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._dead: dict[Func, Set[int]] = {}
        self._assigned: Set[str] | None = None
        self._never_set = NeverSet(folder)
        self._given_once = GivenOnce(folder)

    def has(self, func: Func, at: int) -> bool:
        """Tell whether it is proved that no run of a function gets to a statement."""
        known = self._dead.get(func)
        if known is None:
            jumps = any(isinstance(step, Leave) and step.how == "goto" for step in steps(func.fact.flow))
            block = self.folder.flow.outline(func).block
            known = self._dead[func] = frozenset(() if jumps else self._in(block, func))
        return at in known

    def without(self, calls: Iterable[Invocation]) -> Iterator[Invocation]:
        """Yield the calls of which it is not proved that no run gets there."""
        return (call for call in calls if not self.has(call.func, call.at))

    def decided(self, test: Expr, env: Env) -> bool | None:
        """Tell whether a condition holds whatever happens; None where that is open."""
        if self._is_fixed(test, env.func):
            return self.folder.flow.truth(test, env)
        if not isinstance(test, Op) or test.op not in _ENDING:
            return None
        ends = _ENDING[test.op]
        return ends if any(self.decided(part, env) is ends for part in test.operands) else None

    def _in(self, block: Block, func: Func, around: Sequence[int] = ()) -> Iterator[int]:
        """Such statements of a block; `around`: those that have run when it begins."""
        before = list(around)
        for at, step in enumerate(block):
            if isinstance(step, int):
                before.append(step)
            elif isinstance(step, Branch):
                yield from self._in_branch(step, func, before)
            elif isinstance(step, Switch) and step.subject == _CHAIN:
                yield from self._in_chain(step, func, before)
            elif isinstance(step, Loop) and step.test is not None and not step.first:
                holds = self.decided(step.test, Env(func, 0))
                yield from statements(step.body) if holds is False else self._in(step.body, func, before)
            elif not isinstance(step, Leave):
                for inner in blocks(step):
                    yield from self._in(inner, func, before)
            if self._leaves(step, func, before):
                yield from statements(block[at + 1 :])
                return

    def _in_branch(self, step: Branch, func: Func, before: Sequence[int]) -> Iterator[int]:
        holds = self._holds(step.test, func, before)
        for side, taken in ((step.then, True), (step.other, False)):
            yield from statements(side) if holds is (not taken) else self._in(side, func, before)

    def _in_chain(self, step: Switch, func: Func, before: Sequence[int]) -> Iterator[int]:
        """Of a chain of `else if` what no run gets to: what does not hold, and all behind what does."""
        met = False
        for case in step.cases:
            holds = self._holds(case.tests[0], func, before) if case.tests else None
            yield from statements(case.body) if met or holds is False else self._in(case.body, func, before)
            met = met or holds is True

    def _holds(self, test: Expr, func: Func, before: Sequence[int]) -> bool | None:
        """Whether a test holds, which may ask for what the function gave a literal before."""
        return self.decided(self._given_once.put_in(test, func, before), Env(func, 0))

    def _leaves(self, step: Step, func: Func, before: Sequence[int]) -> bool:
        """Whether a step surely leaves the block: a way out, a return, or both sides of a branch."""
        if isinstance(step, int):
            return func.fact.body[step].kind == "return" or self.folder.flow.exceptions.calls_what_raises(func, step)
        if isinstance(step, Leave):
            return True
        if not isinstance(step, Branch):
            return False
        holds = self._holds(step.test, func, before)
        sides = (step.then, step.other) if holds is None else (step.then if holds else step.other,)
        return all(any(self._leaves(inner, func, before) for inner in side) for side in sides)

    # --- conditions ----------------------------------------------------------------------------------------

    def _is_fixed(self, expr: Expr, func: Func) -> bool:
        if isinstance(expr, Constant | Number | Text):
            return True
        if isinstance(expr, Op):
            return bool(expr.operands) and all(self._is_fixed(part, func) for part in expr.operands)
        if isinstance(expr, Member):
            return expr.base == THIS and self._never_set.has(expr.name, func)
        return isinstance(expr, Name) and self._is_constant(expr.id, func)

    def _is_constant(self, name: str, func: Func) -> bool:
        """Whether a name means a constant of C++, or a variable of a module that nobody gives anything else."""
        if name in self.folder.flow.effects(func).own:
            return False
        if self._never_set.has(name, func):
            return True
        if func.file.language == "cpp":
            found = self.folder.scope.constant(name, Env(func))
            traits = found[0].traits if found is not None else ()
            return "default" not in traits and not _FIXED.isdisjoint(traits)
        bound = [entry for entry in func.file.facts.constants if entry.name == name]
        return len(bound) == 1 and name not in self._assigned_from_outside()

    def _assigned_from_outside(self) -> Set[str]:
        """The names that any function gives something else as those of an object, which may be a module."""
        if self._assigned is None:
            self._assigned = frozenset(self._members())
        return self._assigned

    def _members(self) -> Iterator[str]:
        for group in self.folder.program.functions.values():
            for func in group:
                for statement in func.fact.body:
                    if isinstance(statement.target, Member):
                        yield statement.target.name
