"""Which statements may be proved to raise, before anything is run: what is left out is never asked for."""

from __future__ import annotations

from collections.abc import Callable, Set

from ecm_parsers.source.expr import Call, Constant, Member, Name
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Attempt, Block, Branch, Later, Leave, Step, blocks

from ecm_extract.infer.raising_calls import has_operation, operation, unpacks
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Func
from ecm_extract.link.index.program import Program


class Throwing:
    """Knows which functions raise, and which may, by what stands in them and by what they call."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._own: dict[Func, frozenset[int]] = {}
        self._calling: dict[tuple[Func, bool], frozenset[int]] = {}
        self._tree: Set[str] | None = None
        self._always: Set[str] | None = None

    def is_provable(self, func: Func, at: int, handled: bool) -> bool:
        """Tell whether a statement has anything of which it can be known that it raises.

        Args:
            func: the function.
            at: the statement.
            handled: also what it calls of the tree, which may raise for some arguments.
        """
        return at in self._operations(func) or at in self._calls(func, handled)

    def always(self, func: Func) -> bool:
        """Tell whether no way through a function leads out of it but by an exception."""
        return _raises_in(_steps(func), func, self._names_of_always())

    def _calls(self, func: Func, handled: bool) -> frozenset[int]:
        """The statements that call functions which raise always, or functions of the tree at all."""
        known = self._calling.get((func, handled))
        if known is None:
            names = self._names_of_tree() if handled else self._names_of_always()
            found = (at for at in range(len(func.calls)) if self._calls_any(func, at, names))
            known = self._calling[func, handled] = frozenset(found)
        return known

    def _calls_any(self, func: Func, at: int, names: Set[str]) -> bool:
        return any(_last(call) in names for call in func.calls[at])

    def _operations(self, func: Func) -> frozenset[int]:
        """The statements with operations that raise under a condition that can be known."""
        known = self._own.get(func)
        if known is None:
            empty = {each.target.id for each in func.fact.body if isinstance(each.target, Name) and _is_nothing(each)}
            known = self._own[func] = frozenset(
                at
                for at, each in enumerate(func.fact.body)
                if unpacks(each)
                or has_operation(each.value, func.file.language, empty)
                or has_operation(each.target, func.file.language, empty)
            )
        return known

    # --- names ---------------------------------------------------------------------------------------------

    def _names_of_tree(self) -> Set[str]:
        """The names of functions of the tree, and of classes."""
        if self._tree is None:
            self._tree = {*self.program.functions, *self.program.classes}
        return self._tree

    def _names_of_always(self) -> Set[str]:
        """The names of functions that all raise, whatever they are called with."""
        if self._always is None:
            self._always = _grown(set(), self._raising_by)
        return self._always

    def _raising_by(self, found: Set[str]) -> Set[str]:
        """The names of functions that raise since they throw, or call one of some functions."""
        return {name for name, group in self.program.functions.items() if self._all_raise(group, found)}

    def _all_raise(self, group: list[Func], found: Set[str]) -> bool:
        bodies = [func for func in group if func.fact.body or func.fact.flow]
        return bool(bodies) and all(_raises_in(_steps(func), func, found) for func in bodies)


def _grown(first: Set[str], more: Callable[[Set[str]], Set[str]]) -> Set[str]:
    """Names with those that follow from them, and so on."""
    found: Set[str] = first
    while True:
        grown = found | more(found)
        if len(grown) == len(found):
            return found
        found = grown


def _raises_in(block: Block, func: Func, names: Set[str]) -> bool:
    """Whether steps surely raise, by themselves or by a call of some functions, before they may leave otherwise."""
    for step in block:
        if isinstance(step, Leave):
            return step.how == "throw"
        if isinstance(step, Branch) and all(_raises_in(side, func, names) for side in (step.then, step.other)):
            return True
        if isinstance(step, Attempt) or _may_leave(step, func):
            return False
        if isinstance(step, int) and any(_raises_always(call, func, names) for call in func.calls[step]):
            return True
    return False


def _raises_always(call: Call, func: Func, names: Set[str]) -> bool:
    known = operation(call, func.file.language)
    return _last(call) in names or (known is not None and known.when == "always")


def _may_leave(step: Step, func: Func) -> bool:
    """Whether a function may be left within a step other than by an exception."""
    if isinstance(step, int):
        return func.fact.body[step].kind == "return"
    if isinstance(step, Later | Leave):
        return isinstance(step, Leave) and step.how != "throw"
    return any(_may_leave(inner, func) for block in blocks(step) for inner in block)


def _steps(func: Func) -> Block:
    return func.fact.flow or tuple(range(len(func.fact.body)))


def _is_nothing(statement: Statement) -> bool:
    return statement.value == Constant("null")


def _last(call: Call) -> str:
    callee = call.callee
    return callee.name if isinstance(callee, Member) else last_name(callee.id) if isinstance(callee, Name) else ""
