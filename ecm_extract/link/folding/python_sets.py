"""Sets of Python: what they are made of, and `a | b`, `a.union(b)` and the like, which give one more."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Final, TypeAlias

from ecm_parsers.source.expr import Expr, Op

from ecm_extract.infer.compute import UNKNOWN
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold_lists import ListFolder

_Set: TypeAlias = "dict[str | float, Bound]"
"""Elements by their values."""
_Work: TypeAlias = Callable[[_Set, _Set], _Set]

_OPERATORS: Final[Mapping[str, _Work]] = MappingProxyType(
    {
        "|": lambda a, b: a | b,
        "&": lambda a, b: {key: each for key, each in a.items() if key in b},
        "-": lambda a, b: {key: each for key, each in a.items() if key not in b},
        "^": lambda a, b: {key: each for key, each in (a | b).items() if (key in a) != (key in b)},
    }
)
SET_OPERATORS: Final = frozenset(_OPERATORS)
"""docs.python.org: set types, operators."""
_METHODS: Final[Mapping[str, str]] = MappingProxyType(
    {"union": "|", "intersection": "&", "difference": "-", "symmetric_difference": "^"}
)
SET_METHODS: Final = frozenset(_METHODS)
"""docs.python.org: set types, methods that give a set and leave the one that they are of."""


def set_of(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    """Return the elements of `set(rows)`, which have no order: None where it matters."""
    if call.keywords or len(call.args) > 1:
        return None
    return _for_asker(lists, lists.items(call.args[0], env) if call.args else [])


def set_by_method(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    """Return the elements of `a.union(b, c)`; None when not all are known, or their order matters."""
    if call.receiver is None or call.keywords:
        return None
    return _combined(lists, _METHODS[call.last], (call.receiver, *call.args), env)


def set_by_operator(lists: ListFolder, expr: Op, env: Env) -> list[Bound] | None:
    """Return the elements of `a | b`; None when not all are known, or their order matters."""
    return _combined(lists, expr.op, expr.operands, env)


def _combined(lists: ListFolder, sign: str, sides: Sequence[Expr], env: Env) -> list[Bound] | None:
    made: _Set | None = None
    for side in sides:
        more = _by_value(lists, lists.in_any_order(side, env))
        if more is None:
            return None
        made = more if made is None else _OPERATORS[sign](made, more)
    return _for_asker(lists, list((made or {}).values()))


def _by_value(lists: ListFolder, items: list[Bound] | None) -> _Set | None:
    """The elements by their values; None where the value of one is not proved."""
    found: _Set = {}
    for item in items or ():
        values = lists.fold(item, item.env)
        data = data_in(values[0]) if len(values) == 1 and is_proved(values[0]) else UNKNOWN
        if not isinstance(data, str | int | float):
            return None
        found.setdefault(data, item)
    return None if items is None else found


def _for_asker(lists: ListFolder, items: list[Bound] | None) -> list[Bound] | None:
    return items if items is None or len(items) < 2 or lists.any_order else None
