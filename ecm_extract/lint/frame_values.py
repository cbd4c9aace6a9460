"""Which calls of C++ give a value in another frame: those of a table, and functions that show it by their types."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cache

import msgspec
from ecm_parsers.source.expr import Call, Expr, Member, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.spelling import plain, pointee
from ecm_extract.link.code.units import Func
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.objects import Objects
from ecm_extract.shipped import shipped_as


class ValueRow(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Types of values that are said in a frame; the head of the table says what each column means."""

    source: str
    names: frozenset[str] = frozenset()
    inside: tuple[str, ...] = ()


class FunctionRow(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """Functions of a library that give such a value in another frame, with `of` methods of these classes."""

    source: str
    names: frozenset[str]
    of: frozenset[str] = frozenset()


class FrameValueTable(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The whole table."""

    value: tuple[ValueRow, ...]
    function: tuple[FunctionRow, ...]
    method: tuple[FunctionRow, ...]


@cache
def frame_value_table() -> FrameValueTable:
    """Return the table."""
    return shipped_as("lint/frame_values.toml", FrameValueTable)


class Conversions:
    """Tells which statements of a function declare a variable that holds a value in another frame.

    A function of the tree converts when it gives a value by value, takes one of that type, and has nothing else to
    write to: it is no method that may change its object.
    """

    def __init__(self, func: Func, objects: Objects) -> None:
        self._func, self._objects, self._program = func, objects, objects.program

    def declares(self, at: int) -> bool:
        """Tell whether a statement of the function, by its index, does."""
        statement = self._func.fact.body[at]
        value = statement.value
        if not isinstance(value, Call) or not value.args or "&" in statement.type:
            return False
        return self._is_of_library(value, at) or (self._is_of_tree(value) and self._is_framed(statement, at))

    def _is_of_library(self, call: Call, at: int) -> bool:
        table, callee = frame_value_table(), call.callee
        if isinstance(callee, Name):
            names = self._program.readings(callee.id, self._func.file, self._func.scope)
            return any(name in row.names for row in table.function for name in names)
        if not isinstance(callee, Member):
            return False
        rows = [row for row in table.method if callee.name in row.names]
        classes = self._readings(self._type(callee.base, at)) if rows else ()
        return any(cls in row.of for row in rows for cls in classes)

    def _is_of_tree(self, call: Call) -> bool:
        meant = self._meant(call)
        return bool(meant) and all(map(_converts, meant))

    def _meant(self, call: Call) -> Sequence[Func]:
        """The functions and methods of the tree that a call can mean, by its name and the number of its arguments."""
        if not isinstance(call.callee, Name):
            return ()
        owner, _, name = call.callee.id.rpartition("::")
        func, program = self._func, self._program
        cls = program.class_named(owner, func.file, func.scope) if owner else func.cls
        methods = (each for entry in (program.ancestry(cls) if cls else ()) for each in entry.methods)
        named = [each for each in methods if each.fact.name == name]
        found = named or program.functions_named(call.callee.id, func.file, func.scope)
        return [each for each in found if each.arity[0] <= len(call.args) <= each.arity[1]]

    def _is_framed(self, statement: Statement, at: int) -> bool:
        """Whether the table has the type of the variable, or of what is converted where the variable has `auto`."""
        written = statement.type
        if not written or "auto" in written.split():
            written = self._converted_type(statement.value, at)
        names = self._readings(written)
        return any(
            name in row.names or name.startswith(row.inside) for row in frame_value_table().value for name in names
        )

    def _converted_type(self, value: Expr | None, at: int) -> str:
        """The type of what a chain of conversions begins with, unless one of them names its own."""
        while isinstance(value, Call) and (meant := self._meant(value)) and all(map(_converts, meant)):
            given = {_kept_type(each) for each in meant}
            named = given - {name for each in meant for name in each.fact.template}
            if named:
                return named.pop() if len(given) == 1 else ""
            value = value.args[_taken(meant[0])[0]]
        return self._type(value, at) if value is not None else ""

    def _type(self, expr: Expr, at: int) -> str:
        return self._objects.type_of(expr, Env(self._func, at))

    def _readings(self, written: str) -> Iterable[str]:
        name = plain(pointee(written))
        return self._program.readings(name, self._func.file, self._func.scope) if name else ()


def _converts(func: Func) -> bool:
    """Whether a function takes a value and gives another one of its type, and changes nothing."""
    traits = func.fact.traits
    is_pure = func.cls is None or not {"static", "const"}.isdisjoint(traits)
    is_value = _kept_type(func) and "reference" not in traits and len(_taken(func)) == 1
    return bool(is_value) and is_pure and all(map(_is_read, _referred(func)))


def _kept_type(func: Func) -> str:
    return plain(func.fact.returns)


def _taken(func: Func) -> Sequence[int]:
    """The places of the parameters that have the type of what a function gives."""
    kept = _kept_type(func)
    return [at for at, parameter in enumerate(func.fact.params) if plain(parameter.type) == kept]


def _referred(func: Func) -> Iterator[str]:
    """The types of parameters through which a function sees what is its caller's."""
    return (parameter.type for parameter in func.fact.params if parameter.type.rstrip().endswith(("&", "*")))


def _is_read(written: str) -> bool:
    return "const" in written.split()
