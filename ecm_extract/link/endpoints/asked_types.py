"""The type that a parameter is asked for where it is read: `get_parameter("rate").as_double()`."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Set
from functools import cache
from typing import Final, NamedTuple

import msgspec
from ecm_parsers.source.expr import THIS, Call, Expr, Member, Name, Text

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.folding.data import declared_type, plain_type
from ecm_extract.link.folding.fold import Folder
from ecm_extract.link.running.env import Env
from ecm_extract.shipped import shipped_as

_READ: Final = "get_parameter"


class _Template(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    names: frozenset[str]


class _Asking(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Types by what names them, of C++ and of Python."""

    cpp: Mapping[str, str]
    python: Mapping[str, str]
    template: _Template


@cache
def _asking() -> _Asking:
    return shipped_as("link/endpoints/asked_types.toml", _Asking)


def asked_type(call: Invocation) -> str | None:
    """Return the type that the statement of a call asks its value for; None where it does not, or for several."""
    found = {kind for kind in _kinds(call) if kind is not None}
    return found.pop() if len(found) == 1 else None


class AskedElsewhere:
    """Tells for what type the methods of a class, or a function, read a parameter by its name; each is read once.

    Args:
        folder: knows what they read parameters into.
        type_of: gives the type of a parameter that a variable of C++ takes.
    """

    def __init__(self, folder: Folder, type_of: Callable[[Expr, Env], str | None]) -> None:
        self.folder = folder
        self._type_of = type_of
        self._of: dict[Cls | Func, frozenset[_Asked]] = {}

    def type_of(self, name: Expr | None, call: Invocation) -> str | None:
        """Return the type that others than the statement of a call read its parameter for; None for several."""
        unit = call.func.holder or call.func
        if not isinstance(name, Text):
            return None
        if unit not in self._of:
            methods = unit.methods if isinstance(unit, Cls) else (unit,)
            self._of[unit] = frozenset(each for func in methods for each in self._asked_in(func))
        found = {each.kind for each in self._of[unit] if each.name == name.value and each.node == _node(call.receiver)}
        return found.pop() if len(found) == 1 else None

    def _asked_in(self, func: Func) -> Iterator[_Asked]:
        yield from _asked_in(func)
        for read in (each for reads in self.folder.reads.all_written(func).values() for each in reads):
            kind = self._type_of(read.out, Env(func, read.at)) if func.file.language == "cpp" else None
            calls = (call for call in func.calls[read.at] if read.out in call.args and read.name in call.args)
            receiver = next((call.callee.base for call in calls if isinstance(call.callee, Member)), None)
            if kind is not None and isinstance(read.name, Text):
                yield _Asked(read.name.value, _node(receiver), kind)


class _Asked(NamedTuple):
    """A type for which a parameter of a node is read."""

    name: str
    node: Expr
    kind: str


def _asked_in(func: Func) -> Iterator[_Asked]:
    named = _asking().python if func.file.language == "python" else _asking().cpp
    for statement in func.fact.body:
        for expr, _ in expressions(statement):
            read = _read_for(expr.base) if isinstance(expr, Member) and expr.name in named else None
            if isinstance(expr, Member) and read is not None and isinstance(read.args[0], Text):
                receiver = read.callee.base if isinstance(read.callee, Member) else None
                yield _Asked(read.args[0].value, _node(receiver), named[expr.name])


def _read_for(expr: Expr) -> Call | None:
    """Return the call that reads the parameter whose value an expression takes: `get_parameter("a").as_int()`."""
    while isinstance(expr, Call):
        if len(expr.args) == 1 and _last_part(expr.callee) == _READ:
            return expr
        if not isinstance(expr.callee, Member):
            return None
        expr = expr.callee.base
    return None


def _node(receiver: Expr | None) -> Expr:
    return receiver or THIS


def _kinds(call: Invocation) -> Iterator[str | None]:
    rows = _asking()
    named = rows.python if call.func.file.language == "python" else rows.cpp
    for expr, _ in expressions(call.statement):
        if isinstance(expr, Member) and expr.name in named and _is_of(expr.base, call):
            yield named[expr.name]
        if isinstance(expr, Call) and expr.types and _is_of(_receiver(expr, rows.template.names), call):
            yield declared_type(plain_type(expr.types[0]))
    yield from _of_variable(call, named)


def _of_variable(call: Invocation, named: Mapping[str, str]) -> Iterator[str]:
    """What a function asks the variable for that it reads a parameter into: `node->get_parameter("rate", read)`."""
    read = call.args[1] if call.last == _READ and len(call.args) > 1 else None
    if isinstance(read, Name):
        for statement in call.func.fact.body:
            for expr, _ in expressions(statement):
                if isinstance(expr, Member) and expr.name in named and expr.base == read:
                    yield named[expr.name]


def _receiver(call: Call, methods: Set[str]) -> Expr | None:
    """Return the object of a call of one of these methods."""
    return call.callee.base if isinstance(call.callee, Member) and call.callee.name in methods else None


def _is_of(expr: Expr | None, call: Invocation) -> bool:
    """Whether an object is what a call returned, or what `.get_parameter_value()` makes of that."""
    while isinstance(expr, Call):
        callee = expr.callee
        if expr.args == call.args and _last_part(callee) == call.last and expr.args:
            return True
        if not isinstance(callee, Member):
            return False
        expr = callee.base
    return False


def _last_part(callee: Expr) -> str:
    """Return the name of what is called, without the object or the scope before it."""
    return str(getattr(callee, "name", None) or getattr(callee, "id", "")).rpartition("::")[2]
