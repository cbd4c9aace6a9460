"""Attributes that classes of Python have, beside those of their objects: which of them somebody may change."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Set
from functools import cached_property
from typing import TYPE_CHECKING, Final, NamedTuple

from ecm_parsers.source.expr import THIS, Call, Expr, Items, Member, Name, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.infer.unpacking import unstarred
from ecm_extract.link.code.decorators import is_of_class
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import children, last_of

if TYPE_CHECKING:
    from ecm_extract.link.index.program import Program

_SETTERS: Final = frozenset({"setattr", "delattr"})
_TESTS: Final = frozenset({"isinstance", "issubclass"})
_ANY: Final = "*"
"""Stands for every attribute."""
_OF_CLASS: Final = frozenset({"cls", "__class__", "type"})
"""How a class is written of which the name is not said."""


class _Given(NamedTuple):
    """An attribute that somebody gives something, and what it is an attribute of, by the last part of its name."""

    owner: str
    name: str


class ClassAttributes:
    """Looks through the functions of Python once; which object is meant that is no class need not be known."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._known: dict[Cls, Mapping[str, Expr]] = {}

    def of(self, cls: Cls) -> Mapping[str, Expr]:
        """Return what the body of a class gives it; of several things the last one."""
        known = self._known.get(cls)
        if known is None:
            given = (each for each in cls.file.facts.constants if each.scope == cls.qualified)
            known = self._known[cls] = {each.name: each.value for each in given if each.value is not None}
        return known

    def may_change(self, name: str, cls: Cls, owner: Cls) -> bool:
        """Tell whether somebody may give a class, or the base that it has an attribute of, something else there."""
        lineage = self.program.ancestry(cls)
        if "remade" in owner.fact.traits:
            return True
        changed = {*self._changed.get(name, ()), *self._changed.get(_ANY, ())}
        if not changed:
            return False
        named = {each.fact.name for each in lineage[: lineage.index(owner) + 1]}
        return not changed.isdisjoint(named | _OF_CLASS) or not self._values.isdisjoint(named)

    def is_chosen(self, name: str, owner: Cls) -> bool:
        """Tell whether the body of a class gives it an attribute under a condition, or by something that is called."""
        return _Given(owner.fact.name, name) in self._begun

    @cached_property
    def _functions(self) -> list[Func]:
        return [func for func in self.program.every_function() if func.file.language == "python"]

    @cached_property
    def _begun(self) -> Set[_Given]:
        every = ((func, entry) for func in self._functions for entry in func.fact.body)
        begun = ((func, entry) for func, entry in every if _begins(entry, func))
        return frozenset(each for func, entry in begun for each in _given(entry, func))

    @cached_property
    def _changed(self) -> Mapping[str, Set[str]]:
        """Attribute -> what it is changed of, other than of the object at hand."""
        found: dict[str, set[str]] = defaultdict(set)
        for func in self._functions:
            for statement in func.fact.body:
                for given in _given(statement, func) if not _begins(statement, func) else ():
                    found[given.name].add(given.owner)
            for call in (call for group in func.calls for call in group):
                for given in _set_by(call, func):
                    found[given.name].add(given.owner)
        return found

    @cached_property
    def _values(self) -> Set[str]:
        """The names of classes that somebody uses otherwise than to make an object, or to ask for an attribute."""
        found = {name for func in self._functions for name in _used_by(func)}
        return found & self.program.classes.keys()


def _given(statement: Statement, func: Func) -> Iterator[_Given]:
    """Yield the attributes that a statement gives something."""
    pending = [statement.target] if statement.kind != "do" else []
    while pending:
        target = pending.pop()
        if isinstance(target, Items):
            pending += map(unstarred, target.items)
        elif isinstance(target, Member) and (target.base != THIS or _has_class(func)):
            yield _Given(_owner(target.base), target.name)


def _has_class(func: Func) -> bool:
    """Whether a method has a class in the place of an object."""
    return is_of_class(func) or func.fact.name == "__init_subclass__"


def _begins(statement: Statement, func: Func) -> bool:
    """Whether a statement stands in the body of a class whose attribute it gives something."""
    target = statement.target
    if not isinstance(target, Member) or statement.kind != "set":
        return False
    owners = (each for each in func.file.facts.classes if each.name == last_of(target.base))
    return any(each.line <= statement.line <= each.end_line and not func.cls for each in owners)


def _set_by(call: Call, func: Func) -> Iterator[_Given]:
    """Yield the attribute that `setattr` gives something else than the object at hand."""
    if last_of(call.callee) in _SETTERS and call.args and (call.args[0] != THIS or _has_class(func)):
        named = call.args[1] if len(call.args) > 1 else None
        yield _Given(_owner(call.args[0]), named.value if isinstance(named, Text) else _ANY)


def _owner(expr: Expr) -> str:
    return "cls" if expr == THIS else last_of(expr.callee if isinstance(expr, Call) else expr)


def _used_by(func: Func) -> Set[str]:
    """The names that a function uses as values and that are none of its own variables."""
    statements = func.fact.body
    found = {name for entry in statements for expr in (entry.value, entry.target) for name in _used(expr)}
    if func.fact.name == "<module>":
        return found
    targets = {entry.target.id for entry in statements if isinstance(entry.target, Name)}
    return found - targets - {param.name for param in func.fact.params}


def _used(expr: Expr | None) -> Iterator[str]:
    """Yield what an expression names, except for what it calls, asks for an attribute, or tests objects by."""
    pending = [expr] if expr is not None else []
    while pending:
        each = pending.pop()
        if isinstance(each, Name):
            yield each.id
        elif isinstance(each, Member):
            yield each.name
            base = each.base
            while isinstance(base, Member):  # what is asked for an attribute is only asked, by whatever name
                base = base.base
            pending += [] if isinstance(base, Name) else [base]
        elif isinstance(each, Call):
            pending += _within_call(each)
        else:
            pending += children(each)


def _within_call(call: Call) -> Iterator[Expr]:
    tests = last_of(call.callee) in _TESTS
    yield from call.args[:1] if tests else call.args
    yield from (value for _, value in call.keywords)
    if not isinstance(call.callee, Name):
        yield call.callee.base if isinstance(call.callee, Member) else call.callee
