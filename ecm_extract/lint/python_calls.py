"""The functions of the tree that a call in Python may mean."""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Name

from ecm_extract.link.code.calls import dotted_name
from ecm_extract.link.code.own import is_own_member
from ecm_extract.link.code.units import Cls, Func
from ecm_extract.link.index.program import Program


def callees(call: Call, func: Func, program: Program) -> list[Func]:
    """Return the functions that a call inside `func` may reach; empty where the tree does not show them.

    A method of `self` may be that of the class, of a base, or one that a class further down overrides.
    """
    callee = call.callee
    if is_own_member(callee) and func.cls is not None:
        return _methods(callee.name, func.cls, program)
    head = dotted_name(callee).partition(".")[0]
    if not head or head in _bound(func):
        return []
    return [other for other in program.functions_named(dotted_name(callee), func.file) if not other.fact.scope]


def _bound(func: Func) -> set[str]:
    """Names that mean something of the function's own."""
    targets = (entry.target for entry in func.fact.body if func.fact.name != "<module>")
    return {target.id for target in targets if isinstance(target, Name)} | {entry.name for entry in func.fact.params}


def _methods(name: str, cls: Cls, program: Program) -> list[Func]:
    related = [other for other in program.functions.get(name, ()) if other.cls is not None]
    above = [other for entry in program.ancestry(cls) for other in related if other.cls is entry]
    below = [other for other in related if other.cls is not cls and cls in program.ancestry(other.cls or cls)]
    return [*above[:1], *below]
