"""Members that a constructor gives what it gives its node as a name."""

from __future__ import annotations

from ecm_parsers.source.expr import Call, Expr, Name
from ecm_parsers.source.facts import Statement

from ecm_extract.link.code.spelling import last_name
from ecm_extract.link.code.units import Func

_NODES = frozenset({"Node", "LifecycleNode"})


def is_name_of_node(func: Func, statement: Statement) -> bool:
    """Tell whether a constructor gives a member what it gives its node as a name: `Node(name), name_(name)`."""
    if statement.kind != "init" or statement.value is None:
        return False
    calls = (entry.value for entry in func.fact.body if entry.kind == "init" and _is_node(entry.target))
    return any(isinstance(call, Call) and call.args[:1] == (_only(statement.value),) for call in calls)


def _is_node(target: Expr | None) -> bool:
    return isinstance(target, Name) and last_name(target.id) in _NODES


def _only(value: Expr) -> Expr:
    """What an initialiser `x_(value)` holds."""
    return value.args[0] if isinstance(value, Call) and len(value.args) == 1 else value
