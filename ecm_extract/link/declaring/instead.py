"""What a helper that reads a parameter gives where nobody set it: `return read if known else fallback`."""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Expr, Member, Name

from ecm_extract.link.code.calls import Invocation


def returned_instead(call: Invocation, out: Expr | None) -> Expr | None:
    """Return what a helper returns where it does not return what it read: one of its parameters; None without one.

    Args:
        call: reads the parameter.
        out: the variable that the call writes it to, where it has one.
    """
    returned = [statement.value for statement in call.func.fact.body if statement.kind == "return"]
    read = out if out is not None else _assigned(call)
    if call.statement.kind != "return" and (read is None or read not in returned):
        return None
    given = {parameter.name for parameter in call.func.fact.params}
    others = {value for value in returned if isinstance(value, Name) and value.id in given}
    return others.pop() if len(others) == 1 else None


def _assigned(call: Invocation) -> Expr | None:
    """The variable that is given nothing but what a call gives."""
    value = call.statement.value
    whole = isinstance(value, Call) and value.line == call.line and value.args == call.args
    return call.statement.target if whole and isinstance(call.statement.target, Name | Member) else None
