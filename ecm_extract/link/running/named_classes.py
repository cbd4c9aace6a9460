"""`Class.method(x)` of Python, where the method is one of the class and not of an object; `object.Class::method(x)`.

Source: Python language reference, "staticmethod" and "classmethod"; [class.qual] of the C++ standard.
"""

from __future__ import annotations

from ecm_parsers.source.expr import Name

from ecm_extract.link.code.calls import Invocation, dotted_name
from ecm_extract.link.code.units import Cls
from ecm_extract.link.index.program import Program


def class_asked(call: Invocation, program: Program) -> Cls | None:
    """Return the class of which a call asks one of its own methods; None of other calls."""
    if call.func.file.language != "python":
        owner = call.path.rpartition("::")[0] if call.receiver is not None else ""
        return program.class_named(owner, call.func.file, call.func.scope) if owner else None
    path = _written(call) if call.receiver is not None else call.path.rpartition(".")[0]
    named = program.class_named(path, call.func.file, call.func.fact.scope) if path else None
    owners = program.ancestry(named) if named is not None else ()
    return named if any(call.last in owner.statics for owner in owners) else None


def _written(call: Invocation) -> str:
    """What stands before the method, where that is no variable."""
    written = dotted_name(call.receiver) if call.receiver is not None else ""
    bare = Name(written.partition(".")[0])
    if bare.id in call.func.given or any(each.target == bare for each in call.func.fact.body):
        return ""
    return written.replace(".", "::")
