"""Which values of Python nobody can change in place, since they are elements of lists that are written out."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from ecm_parsers.source.expr import Call, Constant, Expr, Items, Member, Name, Op, Table
from msgspec.structs import replace

from ecm_extract.infer.effects import is_plain
from ecm_extract.infer.held import State, all_ways

_COPIES: Final = frozenset({"list", "tuple", "sorted", "reversed", "set"})
"""Functions that give the elements of what they get: docs.python.org, built-in functions."""
_KEYS: Final = "keys"
_NOTHING: Final = Constant("null")
MAX_NESTED: Final = 4
"""Lists that are made of others."""
_Key = Callable[[Expr | None], str]


def without_plain(value: Expr, state: State | None, key: _Key) -> Expr:
    """Return what a value is made of, without elements that are texts or numbers, and what is called with these.

    Args:
        value: the value.
        state: what variables hold where it stands.
        key: tells the variable that an expression is.
    """
    if isinstance(value, Op) and value.op == "[]":
        plain = not isinstance(value.operands[1], Op) and _has_plain_elements(value.operands[0], state, key, 0)
        return _NOTHING if plain else value
    if isinstance(value, Call) and any(isinstance(arg, Op | Call) for arg in value.args):
        return replace(value, args=tuple([without_plain(arg, state, key) for arg in value.args]))
    return value


def _has_plain_elements(listed: Expr, state: State | None, key: _Key, depth: int) -> bool:
    """Whether all elements of a list are such values."""
    if isinstance(listed, Items):
        return all(map(is_plain, listed.items))
    if depth >= MAX_NESTED:
        return False
    if isinstance(listed, Name | Member):
        return _is_held(listed, state, key, lambda held, then: _has_plain_elements(held, then, key, depth + 1))
    if not isinstance(listed, Call) or listed.keywords:
        return False
    if isinstance(listed.callee, Name) and listed.callee.id in _COPIES and len(listed.args) == 1:
        return _has_plain_elements(listed.args[0], state, key, depth + 1)
    of_table = isinstance(listed.callee, Member) and listed.callee.name == _KEYS and not listed.args
    return of_table and isinstance(listed.callee, Member) and _has_plain_keys(listed.callee.base, state, key)


def _has_plain_keys(table: Expr, state: State | None, key: _Key) -> bool:
    if isinstance(table, Table):
        return all(is_plain(entry) for entry, _ in table.entries)
    return _is_held(table, state, key, lambda held, _: isinstance(held, Table) and _has_plain_keys(held, None, key))


def _is_held(variable: Expr, state: State | None, key: _Key, fits: Callable[[Expr, State | None], bool]) -> bool:
    """Whether all that a variable may hold fits; who reached its elements left which ones it has."""
    pending = list(all_ways(state.holds.get(key(variable), ()))) if state is not None else []
    known = bool(pending)
    while pending and known:
        held = pending.pop()
        if held.how == "reached":
            pending += all_ways(held.before)
            known = bool(held.before)
        else:
            then = held.env.state if held.env is not None else None
            known = held.how == "value" and held.expr is not None and fits(held.expr, then)
    return known
