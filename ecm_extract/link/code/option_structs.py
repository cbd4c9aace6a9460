"""Calls that get their arguments in a struct, read as if they got them one by one.

`options.topic = "in"; nh.subscribe(options)` is `nh.subscribe("in", ...)`. Rows: `option_structs.toml`.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from types import MappingProxyType

import msgspec
from ecm_parsers.source.expr import Call, Constant, Expr, Member, Name, Text
from ecm_parsers.source.facts import Statement
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name, plain
from ecm_extract.shipped import shipped

_UNSET = Constant("null")


class OptionStruct(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One row.

    Attributes:
        call: what takes the struct. struct: last part of its name.
        fields: its fields in the order of the arguments of the call without it. type: the field that holds the type.
        fill: functions that take the same arguments in that order, of the class or of the object.
    """

    call: str
    struct: str
    fields: tuple[str, ...]
    type: str
    fill: tuple[str, ...]


@cache
def _rows() -> Mapping[str, OptionStruct]:
    rows = msgspec.convert(shipped("link/code/option_structs.toml")["options"], list[OptionStruct])
    return MappingProxyType({row.call: row for row in rows})


def spread(call: Invocation) -> Invocation:
    """Return a call with the fields of its struct as arguments; any other call as it is."""
    row = _rows().get(call.last)
    if row is None or len(call.args) != 1 or call.receiver is None or call.func.file.language != "cpp":
        return call
    filled = _Filled(row, call)
    if not filled.is_struct:
        return call
    args, types = filled.result()
    return replace(call, args=args, types=types)


class _Filled:
    """What one struct holds when it is handed over: what was filled in last counts."""

    def __init__(self, row: OptionStruct, call: Invocation) -> None:
        self.row = row
        self.values: dict[str, Expr] = {}
        self.types: tuple[str, ...] = ()
        (given,) = call.args
        self.is_struct = self._take(given)
        if isinstance(given, Name):
            for statement in call.func.fact.body[: call.at]:
                self._read(statement, given)

    def result(self) -> tuple[tuple[Expr, ...], tuple[str, ...]]:
        """Return the arguments in their order, and the template arguments."""
        return tuple(self.values.get(field, _UNSET) for field in self.row.fields), self.types

    def _read(self, statement: Statement, struct: Name) -> None:
        target, value = statement.target, statement.value
        if target == struct:
            made = last_name(plain(statement.type)) == self.row.struct
            self.is_struct = self._take(value) or made or self.is_struct
        elif isinstance(target, Member) and target.base == struct and value is not None:
            self._set(target.name, value)
        elif isinstance(value, Call) and isinstance(value.callee, Member) and value.callee.base == struct:
            self._fill(value, value.callee.name)

    def _take(self, value: Expr | None) -> bool:
        """`SubscribeOptions::create<T>("in", 1, ...)`."""
        if not isinstance(value, Call) or not isinstance(value.callee, Name):
            return False
        owner, _, name = value.callee.id.rpartition("::")
        if last_name(owner) != self.row.struct:
            return False
        self._fill(value, name)
        return True

    def _fill(self, call: Call, name: str) -> None:
        if name in self.row.fill:
            self.values.update(zip(self.row.fields, call.args, strict=False))
            self.types = call.types[:1]

    def _set(self, field: str, value: Expr) -> None:
        if field == self.row.type:
            self.types = _type_in(value) or self.types
        else:
            self.values[field] = value


def _type_in(value: Expr) -> tuple[str, ...]:
    """The type that a field holds: as text, or asked of the traits of a message."""
    if isinstance(value, Text):
        return (value.value.replace("/", "::"),)
    return value.types[:1] if isinstance(value, Call) else ()
