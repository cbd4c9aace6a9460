"""What calls of Python may change, and what the functions that they run mention, by the names of it.

Whose member a name is need not be known: who changes one of that name is taken to change it.
"""

from __future__ import annotations

from collections.abc import Iterator, Set
from functools import cached_property
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Op

from ecm_extract.infer.library_calls import calls_of
from ecm_extract.infer.unpacking import unstarred
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import expressions, last_of

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program

MAX_REACHED: Final = 100
"""Functions that are looked through for one call, each of which calls the next ones; more may change anything."""


class Named(NamedTuple):
    """Names of members and variables, by what is done with them.

    Attributes:
        written: those that may change.
        read: those that are mentioned.
        given: whether what is passed may change.
    """

    written: frozenset[str]
    read: frozenset[str]
    given: bool = False


NOTHING: Final = Named(frozenset(), frozenset())


class NamesByCalls:
    """Looks through the functions of a name; each function, and each name, once."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._known: dict[str, Named] = {}
        self._own: dict[Func, Named] = {}
        self._called: dict[Func, Set[str]] = {}

    def of(self, call: Call) -> Named:
        """Return what a call may change and mention: itself, and the functions of the tree that it may run."""
        found = self._by_name(last_of(call.callee))
        written = {last_of(arg) for arg in call.args} if found.given else set[str]()
        if isinstance(call.callee, Member) and call.callee.name in self._changing:
            written.add(root_name(call.callee.base))
        return found._replace(written=found.written | (written - {""})) if written else found

    def is_run(self, call: Call) -> bool:
        """Tell whether a call may run a function of the tree, or changes what it is called on."""
        own = isinstance(call.callee, Member) and call.callee.name in self._changing
        return own or last_of(call.callee) in self.functions

    @cached_property
    def functions(self) -> dict[str, list[Func]]:
        """The functions of Python by their names, constructors by the names of their classes."""
        found: dict[str, list[Func]] = {}
        for func in (each for each in self.program.every_function() if each.file.language == "python"):
            name = func.cls.fact.name if func.is_constructor and func.cls is not None else func.fact.name
            found.setdefault(name, []).append(func)
        return found

    @cached_property
    def _changing(self) -> Set[str]:
        return calls_of("python").changing

    def _by_name(self, name: str) -> Named:
        if name not in self.functions:
            return NOTHING
        known = self._known.get(name)
        if known is None:
            reached = self._reached(name)
            written = frozenset[str]().union(*(self._of(func).written for func in reached))
            read = frozenset[str]().union(*(self._of(func).read for func in reached))
            if len(reached) >= MAX_REACHED:
                written = read = self._written_anywhere
            known = self._known[name] = Named(written, read, any(self._of(func).given for func in self.functions[name]))
        return known

    @cached_property
    def _written_anywhere(self) -> frozenset[str]:
        """The names that any function may change: what a call does of which not all functions are looked through."""
        every = (func for functions in self.functions.values() for func in functions)
        return frozenset[str]().union(*(self._of(func).written for func in every))

    def _reached(self, name: str) -> list[Func]:
        """The functions of a name, and those that they call."""
        found: dict[Func, None] = dict.fromkeys(self.functions[name])
        pending = list(found)
        while pending and len(found) < MAX_REACHED:
            func = pending.pop()
            for called in self._called_by(func):
                more = [each for each in self.functions.get(called, ()) if each not in found]
                found.update(dict.fromkeys(more))
                pending += more
        return list(found)

    def _called_by(self, func: Func) -> Set[str]:
        if func not in self._called:
            self._called[func] = {last_of(call.callee) for group in func.calls for call in group}
        return self._called[func]

    def _of(self, func: Func) -> Named:
        known = self._own.get(func)
        if known is None:
            given = {root_name(each) for each in self._grown(func)}
            outside = set(_assigned(func)) | {name for name in given if name not in _local(func)}
            parts = (expr for statement in func.fact.body for expr, _ in expressions(statement))
            read = frozenset(last_of(expr) for expr in parts if isinstance(expr, Name | Member))
            known = self._own[func] = Named(frozenset(outside - {""}), read, not func.given.isdisjoint(given))
        return known

    def _grown(self, func: Func) -> Iterator[Expr]:
        """What a function changes in place: by methods, or an element of it."""
        for call in (call for group in func.calls for call in group):
            if isinstance(call.callee, Member) and call.callee.name in self._changing:
                yield call.callee.base
        for statement in func.fact.body:
            for target in _targets(statement.target):
                if isinstance(target, Op) and statement.kind != "do":
                    yield target


def root_name(expr: Expr) -> str:
    """Return the name of the variable, or the member, of which something is an element."""
    while isinstance(expr, Op) and expr.op == "[]":
        expr = expr.operands[0]
    return last_of(expr)


def _targets(target: Expr | None) -> Iterator[Expr]:
    if isinstance(target, Items):
        for each in target.items:
            yield from _targets(unstarred(each))
    elif target is not None:
        yield target


def _assigned(func: Func) -> Iterator[str]:
    """The members, and variables around a function, that it gives something; not those of the object that it makes."""
    for statement in (each for each in func.fact.body if each.kind != "do"):
        for target in _targets(statement.target):
            made = func.is_constructor and isinstance(target, Member) and target.base == THIS
            if isinstance(target, Member) and not made:
                yield target.name
            elif isinstance(target, Name) and target.id in func.fact.shared:
                yield target.id


def _local(func: Func) -> Set[str]:
    """The names that are variables of a function alone."""
    bound = {each.id for entry in func.fact.body for each in _targets(entry.target) if isinstance(each, Name)}
    return (bound | func.given) - set(func.fact.shared)
