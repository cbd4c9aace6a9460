"""Calls of Python whose names a star import brings: `from actionlib import *` and `SimpleActionClient(...)`.

What a module outside of the tree has nobody sees: the rows tell which of the names that a call can have is one.
"""

from __future__ import annotations

from collections.abc import Iterator

from ecm_parsers.source.expr import Name
from msgspec.structs import replace

from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.index.program import Program


def starred(call: Invocation, program: Program) -> Iterator[Invocation]:
    """Yield a call by each full name that star imports can give it, the last import first; nothing for what is bound.

    `from actionlib.msg import *` brings `actionlib` too: modules of messages hand on what they import.
    """
    file = call.func.file
    modules = [entry.module for entry in file.facts.imports if entry.name == "*"]
    owner = dotted_name(call.receiver) if call.receiver is not None else ""
    if not modules or file.language != "python" or (not owner and (call.receiver is not None or "." in call.path)):
        return
    written = f"{owner}.{call.path}" if owner else call.path
    head = written.partition(".")[0]
    if not head or head in file.imported or _is_bound(head, call, program):
        return
    handed = program.outside(written, file)
    brought = (written if owner else f"{module}.{written}" for module in reversed(modules) if _hands(module, owner))
    for path in [handed] if handed else dict.fromkeys(brought):
        yield replace(call, path=path, receiver=None)


def _hands(module: str, owner: str) -> bool:
    return not owner or module.partition(".")[0] == owner.partition(".")[0]


def _is_bound(name: str, call: Invocation, program: Program) -> bool:
    """Tell whether the file, or the function at hand, gives a name something else."""
    func, file = call.func, call.func.file
    if program.functions_named(name, file, func.scope) or program.class_named(name, file, func.scope) is not None:
        return True
    own = {entry.name for entry in func.fact.params}
    given = any(statement.target == Name(name) for statement in func.fact.body)
    return name in own or given or program.constant_named(name, file, func.scope) is not None
