"""Node handles that a library of ROS 1 hands to what it loads: controllers and hardware."""

from __future__ import annotations

from functools import cache

import msgspec

from ecm_extract.link.code.units import Func
from ecm_extract.link.index.module_kinds import class_kind
from ecm_extract.link.index.program import Program
from ecm_extract.link.running.values import Value, literal, unknown
from ecm_extract.shipped import shipped


class GivenHandles(msgspec.Struct, frozen=True):
    """One row: what the handles of a method are below; `kind` is that of its class."""

    kind: str
    method: str
    count: int
    below: tuple[str, ...]


@cache
def _rows() -> tuple[GivenHandles, ...]:
    return msgspec.convert(shipped("link/naming/given_handles.toml")["given"], tuple[GivenHandles, ...])


def given_namespace(func: Func, parameter: str, program: Program) -> Value | None:
    """Return what a handle is below that a library gives a method by one of its parameters; None where none does."""
    names = [entry.name for entry in func.fact.params if "NodeHandle" in entry.type]
    kind = class_kind(func.cls, program) if func.cls is not None and parameter in names else None
    fitting = (row for row in _rows() if (row.kind, row.method, row.count) == (kind, func.fact.name, len(names)))
    row = next(fitting, None)
    return _below(row.below[names.index(parameter)]) if row is not None else None


def _below(text: str) -> Value:
    return unknown(text.strip("{}")) if text.startswith("{") else literal(text)
