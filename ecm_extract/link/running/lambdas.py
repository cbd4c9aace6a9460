"""Lambdas that do nothing to the object at hand, so that whoever gets them does nothing to it either."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ecm_parsers.source.expr import Lambda, Name

from ecm_extract.infer.pointing import is_address
from ecm_extract.link.code.spelling import by_value
from ecm_extract.link.code.units import Func
from ecm_extract.link.code.walk import expressions
from ecm_extract.link.running.env import Env

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder


def leaves_object(made: Lambda, env: Env, folder: Folder) -> bool:
    """Tell whether a lambda changes nothing but variables that it, or the function around it, has by value."""
    around, cls = env.func, env.this or env.func.cls
    func = next((each for each in folder.nesting.inner(around) if each.fact.name == made.name), None)
    if func is None or cls is None or "reference" in func.fact.traits or _gives_ways(func, around, folder):
        return False
    if around.file.language == "python":
        own = folder.flow.effects(func).own
        return folder.flow.outline(func).changes.keys() <= own and folder.methods.leaves(func, cls)
    members = {name for entry in folder.program.ancestry(cls) for name in entry.fields}
    types = {name: written for name, written in around.written_types.items() if name not in members}
    types |= func.written_types
    changed = {key.partition(".")[0] for key in folder.flow.outline(func).changes}
    return all(by_value(types.get(name, "")) for name in changed) and folder.methods.leaves(func, cls)


def _gives_ways(func: Func, around: Func, folder: Folder) -> bool:
    """Whether a lambda takes an address, or calls a function that is in a variable: what that does is not seen here."""
    variables = {*func.written_types, *around.written_types}
    if around.file.language == "python":
        variables = {*folder.flow.effects(func).own, *folder.flow.effects(around).own}
    called = any(call.callee == Name(name) for group in func.calls for call in group for name in variables)
    return called or any(is_address(part) for entry in func.fact.body for part, _ in expressions(entry))
