"""What built-in functions and operators of Python make of folded values; None where that is not known.

Source: docs.python.org, Built-in Functions, and Sequence and Mapping Types.
"""

from __future__ import annotations

import operator
from collections.abc import Callable, Mapping, Sequence
from itertools import chain
from types import MappingProxyType
from typing import Any

from ecm_parsers.python_values import Data, Names, PyCall, Table, Value, is_counted, with_more

MAX_ITEMS = 1_000
_LEAVING = frozenset({"get", "keys", "values", "items", "copy", "index", "count"})
"""Methods of lists and dictionaries that leave them as they are: docs.python.org, Sequence and Mapping Types."""
_COMPARING: Mapping[str, Callable[[Any, Any], bool]] = MappingProxyType(
    {
        "==": operator.eq,
        "!=": operator.ne,
        "<": operator.lt,
        "<=": operator.le,
        ">": operator.gt,
        ">=": operator.ge,
    }
)


def called(call: PyCall, names: Names) -> Data:
    """Return what `range(3)`, `enumerate(rows)`, `zip(a, b)`, `len(rows)` or `table.items()` gives.

    Args:
        call: the call; of a function that the file gives another meaning by that name nothing is known.
        names: the variables of the file.
    """
    owner, _, method = call.name.rpartition(".")
    if owner:
        held = names.get(owner)
        parts = _OF_TABLES.get(method)
        return parts(held.data) if parts is not None and held is not None and isinstance(held.data, Table) else None
    function = _FUNCTIONS.get(call.name)
    return function(call.args) if function is not None and not call.keywords and call.name not in names else None


def changed_by(method: str, held: Value, call: PyCall) -> Value | None:
    """Return what a variable holds after a method of it was called: `rows.append(x)`, `table.update(other)`.

    Args:
        method: the method.
        held: what the variable held.
        call: the call.

    Returns:
        The same where the method only reads; None where it is not known any more.
    """
    if method in _LEAVING or not isinstance(held.data, tuple | Table):
        return held
    change = _CHANGING.get((type(held.data), method))
    data = change(held.data, call) if change is not None else None
    return None if data is None else Value(data, held.line)


def _appended(items: tuple[Value, ...], call: PyCall) -> Data:
    return (*items, *call.args[:1])[:MAX_ITEMS]


def _extended(items: tuple[Value, ...], call: PyCall) -> Data:
    return with_more(items, call.args[0]) if call.args else None


def _updated(table: Table, call: PyCall) -> Data:
    tables = [each.data.entries for each in call.args if isinstance(each.data, Table)]
    if len(tables) < len(call.args) or any(key == "**" for key, _ in call.keywords):
        return None
    named = tuple([(Value(key, value.line), value) for key, value in call.keywords])
    return Table((*table.entries, *chain.from_iterable(tables), *named)[:MAX_ITEMS])


def element(owner: Value, key: Value) -> Value | None:
    """Return an element of a list, a tuple or a table; of several entries of one key the last."""
    if isinstance(owner.data, Table):
        for each, value in reversed(owner.data.entries):
            if not _is_plain(each):
                return None
            if _same(each, key):
                return value
        return None
    at = key.data
    if (
        not isinstance(owner.data, tuple)
        or not isinstance(at, int)
        or isinstance(at, bool)
        or not is_counted(owner.data)
    ):
        return None
    return owner.data[at] if -len(owner.data) <= at < len(owner.data) else None


def compared(sign: str, left: Value, right: Value) -> bool | None:
    """Return whether two texts or numbers compare so, or one is among others."""
    if sign in {"in", "not in"}:
        among = _keys(right.data) if isinstance(right.data, Table) else right.data
        if not isinstance(among, tuple) or not all(map(_is_plain, (left, *among))):
            return None
        return any(_same(left, each) for each in among) == (sign == "in")
    function = _COMPARING.get(sign)
    if function is None or not (_is_plain(left) and _is_plain(right)):
        return None
    try:
        return function(left.data, right.data)
    except TypeError:
        return None


def _is_plain(value: Value) -> bool:
    """Whether all of a value is known: no number or text has a hole."""
    return isinstance(value.data, int | float) or (isinstance(value.data, str) and "{" not in value.data)


def _same(one: Value, other: Value) -> bool:
    return _is_plain(one) and _is_plain(other) and one.data == other.data


def _range(args: Sequence[Value]) -> Data:
    bounds = [each.data for each in args if isinstance(each.data, int)]
    if len(bounds) != len(args) or not 1 <= len(bounds) <= 3 or bounds[2:] == [0]:
        return None
    numbers = range(*bounds)
    return tuple([Value(number, args[0].line) for number in numbers]) if len(numbers) <= MAX_ITEMS else None


def _enumerate(args: Sequence[Value]) -> Data:
    items = args[0].data if len(args) == 1 else None
    if not isinstance(items, tuple) or not is_counted(items):
        return None
    return tuple([Value((Value(at, item.line), item), item.line) for at, item in enumerate(items)])


def _zip(args: Sequence[Value]) -> Data:
    lists = [each.data for each in args if isinstance(each.data, tuple) and is_counted(each.data)]
    if not lists or len(lists) != len(args):
        return None
    return tuple([Value(tuple(row), row[0].line) for row in zip(*lists, strict=False)])


def _len(args: Sequence[Value]) -> Data:
    data = args[0].data if len(args) == 1 else None
    items = _keys(data) if isinstance(data, Table) else data
    if not isinstance(items, tuple) or not is_counted(items):
        return None
    if isinstance(data, Table):
        return len({each.data for each in items}) if all(map(_is_plain, items)) else None
    return len(items)


def _list(args: Sequence[Value]) -> Data:
    data = args[0].data if len(args) == 1 else None
    return data if isinstance(data, tuple) else None


def _items(table: Table) -> Data:
    return tuple([Value(pair, pair[0].line) for pair in table.entries])


def _keys(table: Table) -> tuple[Value, ...]:
    return tuple([key for key, _ in table.entries])


def _values(table: Table) -> Data:
    return tuple([value for _, value in table.entries])


_CHANGING: Mapping[tuple[type, str], Callable[[Any, PyCall], Data]] = MappingProxyType(
    {(tuple, "append"): _appended, (tuple, "extend"): _extended, (Table, "update"): _updated}
)
_FUNCTIONS: Mapping[str, Callable[[Sequence[Value]], Data]] = MappingProxyType(
    {"range": _range, "enumerate": _enumerate, "zip": _zip, "len": _len, "list": _list, "tuple": _list}
)
_OF_TABLES: Mapping[str, Callable[[Table], Data]] = MappingProxyType(
    {"items": _items, "keys": _keys, "values": _values}
)
