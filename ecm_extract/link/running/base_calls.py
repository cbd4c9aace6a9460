"""The calls by which constructors make the bases of their objects."""

from __future__ import annotations

from ecm_parsers.source.expr import THIS, Call, Member, Name

from ecm_extract.link.code.calls import Invocation, dotted_name, one_node
from ecm_extract.link.code.own import is_super
from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Cls, Func


def base_call(func: Func, parent: Cls) -> Invocation | None:
    """Return the call by which a constructor makes its base; None of one that leaves that to the language."""
    for at, statement in enumerate(func.fact.body):
        value, target = statement.value, statement.target
        if statement.kind == "init" and isinstance(target, Name) and last_name(target.id) == parent.fact.name:
            args = value.args if isinstance(value, Call) and value.callee == target else (value,) if value else ()
            return Invocation(func, at, statement, target.id, None, one_node(func, args), (), (), statement.line)
        if isinstance(value, Call) and _calls_super(value, parent):
            args = value.args[1:] if value.args[:1] == (THIS,) else value.args
            return Invocation(func, at, statement, "super", None, args, value.keywords, (), statement.line)
    return None


def _calls_super(call: Call, parent: Cls) -> bool:
    callee = call.callee
    if not isinstance(callee, Member) or callee.name != "__init__":
        return False
    return is_super(callee.base) or last_name(dotted_name(callee.base)) == parent.fact.name
