"""Functions and classes that are handed over as values: callbacks, classes for somebody else to make an object of.

Who hands a function or class over has what it declares, as if it had called it. A class given to a template
(`run<Node>()`) is handed over too. Calls that only ask for a type are listed in `handed.toml`.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cache
from typing import NamedTuple

from ecm_parsers.source.expr import Call, Expr, Items, Member, Name, Op, Table, Text
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.spelling import last_name, plain, pointee
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import children
from ecm_extract.link.index.program import Program
from ecm_extract.shipped import shipped_names

_CHOICES = frozenset({"?:", "&", "or", "||", "and"})
_BINDING = frozenset({"let", "set", "return"})
_SUBCLASSES = "__subclasses__"


class Handing(NamedTuple):
    """A place that hands something over: the function, and what it hands over as written."""

    func: Func
    written: str


@cache
def _names(table: str) -> frozenset[str]:
    return shipped_names("link/index/handed.toml", table)


def only_loads(written: str) -> bool:
    """Tell whether a member of this type loads objects of a class, and holds none."""
    return last_name(plain(written)) in _names("loading")


class Handed:
    """The index of everything that is handed over; built when it is asked for the first time."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self._values: dict[str, list[Handing]] | None = None

    def knows(self, name: str) -> bool:
        """Tell whether something of a last name is handed over anywhere."""
        return name in self._index()

    def functions(self, func: Func) -> Iterator[Func]:
        """Yield the functions that hand a function over."""
        for handing in self._index().get(func.fact.name, ()):
            if handing.func is not func and self._means_function(handing, func):
                yield handing.func

    def classes(self, cls: Cls) -> Iterator[Func]:
        """Yield the functions that hand a class over, or all classes that derive from a base of it."""
        for handing in self._index().get(cls.fact.name, ()):
            if handing.func.cls is not cls and self._named(handing.written, handing.func) is cls:
                yield handing.func
        for base in self.program.ancestry(cls)[1:]:
            for handing in self._index().get(f"{base.fact.name}.{_SUBCLASSES}", ()):
                if self._named(handing.written, handing.func) is base:
                    yield handing.func

    def _named(self, written: str, func: Func) -> Cls | None:
        return self.program.class_named(written, func.file, func.scope)

    def _means_function(self, handing: Handing, func: Func) -> bool:
        if func.holder is not None or func.file.language != handing.func.file.language:
            return False
        if func.cls is not None:
            owner = self._named(handing.written.removesuffix(func.fact.name).rstrip(":."), handing.func)
            return owner is not None and func.cls in self.program.ancestry(owner)
        return func in self.program.functions_named(handing.written, handing.func.file, handing.func.scope)

    def _index(self) -> dict[str, list[Handing]]:
        if self._values is None:
            self._values = defaultdict(list)
            for functions in self.program.functions.values():
                for func in functions:
                    for written in _handed_over(func):
                        last = written.removesuffix(f".{_SUBCLASSES}")
                        key = f"{last_name(last)}.{_SUBCLASSES}" if last != written else last_name(written)
                        self._values[key].append(Handing(func, last))
        return self._values


def _handed_over(func: Func) -> Iterator[str]:
    own = {parameter.name for parameter in func.fact.params}
    own |= {
        entry.target.id for entry in func.fact.body if entry.kind in {"let", "each"} and isinstance(entry.target, Name)
    }
    found = dict.fromkeys(name for statement in func.fact.body for name in _of_statement(statement))
    yield from (name for name in found if name not in own)


def _of_statement(statement: Statement) -> Iterator[str]:
    if statement.value is None:
        return
    if statement.kind in _BINDING:
        yield from _of_value(statement.value)
    pending: list[Expr] = [statement.value]
    while pending:
        expr = pending.pop()
        for value in _values_in(expr):
            yield from _of_value(value)
        if isinstance(expr, Call):
            yield from _of_call(expr)
        pending += children(expr)


def _values_in(expr: Expr) -> Sequence[Expr]:
    """The parts of an expression that are handed on as they are."""
    if isinstance(expr, Call):
        return () if _callee(expr) in _names("asking") else (*expr.args, *[value for _, value in expr.keywords])
    if isinstance(expr, Items):
        return expr.items
    if isinstance(expr, Table):
        return [value for _, value in expr.entries]
    return expr.operands if isinstance(expr, Op) and expr.op in _CHOICES else ()


def _of_value(expr: Expr) -> Iterator[str]:
    written = dotted_name(expr)
    if written:
        yield written


def _of_call(call: Call) -> Iterator[str]:
    name = _callee(call)
    if name == _SUBCLASSES and isinstance(call.callee, Member):
        yield from (f"{base}.{_SUBCLASSES}" for base in _of_value(call.callee.base))
    if name == "getattr" and len(call.args) >= 2 and isinstance(call.args[1], Text):
        yield from (f"{module}.{call.args[1].value}" for module in _of_value(call.args[0]))
    if name not in _names("asking"):
        yield from (plain(pointee(written)) for written in call.types)


def _callee(call: Call) -> str:
    if isinstance(call.callee, Member):
        return call.callee.name
    return last_name(call.callee.id) if isinstance(call.callee, Name) else ""
