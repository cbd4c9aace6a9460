"""Functions of libraries that calls of C++ name by less than their whole name, because a `using` brings them."""

from __future__ import annotations

from collections.abc import Set

from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.index.program import Program


def library_function(call: Invocation, functions: Set[str], scope: str, program: Program) -> str | None:
    """Return which of some functions of libraries a call means; None of others, and of methods of an object.

    Args:
        call: the call.
        functions: their whole names.
        scope: where it stands.
        program: which namespaces its file uses, and what the tree itself calls so.
    """
    if call.path.removeprefix("::") in functions:
        return call.path.removeprefix("::")
    file = call.func.file
    if call.receiver is not None or file.language == "python" or call.last not in map(last_name, functions):
        return None
    if program.functions_named(call.path, file, scope):
        return None  # one of the tree is nearer
    return next((each for each in program.readings(call.path, file, scope) if each in functions), None)
