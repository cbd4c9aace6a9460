"""`isinstance(x, dict)` of what is known: a table, a list, a text, a number.

Source: docs.python.org, built-in functions and types. Whether a display is a list or a tuple is not kept.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from ecm_parsers.source.expr import Expr, Items, Name

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.running.env import Env
from ecm_extract.link.running.values import Value, constant, data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold import Folder

_LISTS: Final = frozenset({"list", "tuple", "set"})
_PLAIN: Final = {bool: {"bool", "int"}, int: {"int"}, float: {"float"}, str: {"str"}}
_KNOWN: Final = _LISTS.union({"dict"}, *_PLAIN.values())


def is_instance(call: Invocation, env: Env, folder: Folder) -> tuple[Value, ...] | None:
    """Return whether a value is of one of some types of Python; None where that is not known."""
    asked = _asked(call.args[1])
    kinds = _kinds(call.args[0], env, folder) if asked and asked <= _KNOWN else None
    if not kinds or (kinds == _LISTS and asked & kinds and not {"list", "tuple"} <= asked):
        return None
    return (constant(bool(asked & kinds))._replace(confidence="folded"),)


def _asked(expr: Expr) -> frozenset[str]:
    """The types by their names; nothing where not all are names."""
    names = expr.items if isinstance(expr, Items) else (expr,)
    return frozenset([each.id if isinstance(each, Name) else "" for each in names])


def _kinds(expr: Expr, env: Env, folder: Folder) -> frozenset[str] | None:
    """The types that a value is of, of a list those that it may be of."""
    if folder.tables.entries(expr, env) is not None:
        return frozenset({"dict"})
    if folder.lists.in_any_order(expr, env) is not None:
        return _LISTS
    values = folder.fold(expr, env)
    data = data_in(values[0]) if len(values) == 1 and is_proved(values[0]) else UNKNOWN
    return frozenset(_PLAIN.get(type(data), ()))
