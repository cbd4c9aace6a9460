"""What is known of exceptions before anything is run: their types, and which statements may be proved to raise."""

from __future__ import annotations

from collections.abc import Callable, Set

from ecm_parsers.source.expr import Call, Constant, Expr, Name
from ecm_parsers.source.facts import Statement
from ecm_parsers.source.flow import Attempt, Block, Branch, Later, Leave, Step, blocks

from ecm_extract.infer.kinds import Kind
from ecm_extract.infer.raising_calls import Operation, has_operation, operation, unpacks
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import dotted, last_of
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.exception_types import ExceptionTypes
from ecm_extract.shipped import shipped_names


class Exceptions:
    """Knows types of exceptions, and which functions raise, by what stands in them and by what they call."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._types = ExceptionTypes(program)
        self._own: dict[Func, frozenset[int]] = {}
        self._calling: dict[tuple[Func, bool], frozenset[int]] = {}
        self._tree: Set[str] | None = None
        self._always: Set[str] | None = None
        self._enums: Set[str] | None = None

    def kind(self, spelled: str, func: Func) -> Kind | None:
        """Return the type of exceptions that is written so in a function; None for what is no type that is known."""
        return self._types.kind(spelled, func)

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
        return self._raises(func, self._names_of_always())

    def operation(self, expr: Expr, func: Func) -> Operation | None:
        """Return what an expression does that raises under a condition; None for others, and functions of the tree."""
        known = operation(expr, func.file.language)
        if known is None or not isinstance(expr, Call) or func.file.language != "cpp":
            return known
        return None if isinstance(expr.callee, Name) and expr.callee.id in self.program.functions else known

    def calls_what_raises(self, func: Func, at: int) -> bool:
        """Tell whether a statement does nothing but call a function outside of classes that raises whatever happens."""
        value = func.fact.body[at].value
        if not isinstance(value, Call):
            return False
        if func.file.language == "cpp" and self._is_always(value, func):
            return True
        meant = self.program.functions_named(dotted(value.callee) or "", func.file, func.scope)
        bodies = [each for each in meant if each.fact.body or each.fact.flow]
        return bool(bodies) and all(self.always(each) and not _waits(each) for each in bodies)

    def _calls(self, func: Func, handled: bool) -> frozenset[int]:
        """The statements that call functions which raise always, or functions of the tree at all."""
        known = self._calling.get((func, handled))
        if known is None:
            names = self._names_of_tree() if handled else self._names_of_always()
            found = (at for at in range(len(func.calls)) if self._calls_any(func, at, names))
            known = self._calling[func, handled] = frozenset(found)
        return known

    def _calls_any(self, func: Func, at: int, names: Set[str]) -> bool:
        return any(last_of(call.callee) in names for call in func.calls[at])

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
                or self._calls_any(func, at, self._names_of_enums())
            )
        return known

    # --- names ---------------------------------------------------------------------------------------------

    def _names_of_tree(self) -> Set[str]:
        """The names of functions of the tree, and of classes."""
        if self._tree is None:
            self._tree = {*self.program.functions, *self.program.classes}
        return self._tree

    def _names_of_enums(self) -> Set[str]:
        """The names of enumerations, of which a call looks up a member."""
        if self._enums is None:
            bases = {base.rpartition(".")[2] for base in shipped_names("link/folding/enums.toml", "enums")}
            classes = (cls for group in self.program.classes.values() for cls in group)
            found = (cls for cls in classes if any(base.rpartition(".")[2] in bases for base in cls.fact.bases))
            self._enums = {cls.fact.name for cls in found}
        return self._enums

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
        return bool(bodies) and all(self._raises(func, found) for func in bodies)

    def _raises(self, func: Func, names: Set[str]) -> bool:
        """Whether a function surely raises, also by a call of some functions."""
        return _raises_in(_flow(func), func, lambda call: last_of(call.callee) in names or self._is_always(call, func))

    def _is_always(self, call: Call, func: Func) -> bool:
        known = self.operation(call, func)
        return known is not None and known.when == "always"


def _grown(first: Set[str], more: Callable[[Set[str]], Set[str]]) -> Set[str]:
    """Names with those that follow from them, and so on."""
    found: Set[str] = first
    while True:
        grown = found | more(found)
        if len(grown) == len(found):
            return found
        found = grown


def _raises_in(block: Block, func: Func, raises: Callable[[Call], bool]) -> bool:
    """Whether steps surely raise, by themselves or by a call of some functions, before they may leave otherwise."""
    for step in block:
        if isinstance(step, Leave):
            return step.how == "throw"
        if isinstance(step, Branch) and all(_raises_in(side, func, raises) for side in (step.then, step.other)):
            return True
        if isinstance(step, Attempt) or _may_leave(step, func):
            return False
        if isinstance(step, int) and any(map(raises, func.calls[step])):
            return True
    return False


def _waits(func: Func) -> bool:
    """Whether a call of a function does not run its body, or runs others around it."""
    decorated = bool(func.fact.decorators) and func.file.language == "python"
    return decorated or not {"generator", "coroutine"}.isdisjoint(func.fact.traits)


def _may_leave(step: Step, func: Func) -> bool:
    """Whether a function may be left within a step other than by an exception."""
    if isinstance(step, int):
        return func.fact.body[step].kind == "return"
    if isinstance(step, Later | Leave):
        return isinstance(step, Leave) and step.how != "throw"
    return any(_may_leave(inner, func) for block in blocks(step) for inner in block)


def _flow(func: Func) -> Block:
    return func.fact.flow or tuple(range(len(func.fact.body)))


def _is_nothing(statement: Statement) -> bool:
    return statement.value == Constant("null")
