"""Calls of Python that give lists: `range`, `zip`, `sorted`, methods of tables and texts."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from itertools import combinations, islice, permutations, product, zip_longest
from math import prod
from types import MappingProxyType
from typing import TYPE_CHECKING, Final, TypeAlias

from ecm_parsers.source.expr import Call, Constant, Expr, Items, Lambda, Name, Number, Op, Text

from ecm_extract.infer.compute import UNKNOWN, method
from ecm_extract.infer.held import Held, State
from ecm_extract.link.code.calls import Invocation
from ecm_extract.link.folding.asked_together import asked_together, asking
from ecm_extract.link.folding.paired_tables import MAKERS
from ecm_extract.link.folding.python_sets import SET_METHODS, SET_OPERATORS, set_by_method, set_by_operator, set_of
from ecm_extract.link.running.env import Bound, Env
from ecm_extract.link.running.values import data_in, is_proved

if TYPE_CHECKING:
    from ecm_extract.link.folding.fold_lists import ListFolder

SPLITS = frozenset({"split", "rsplit", "partition", "rpartition"})
"""Methods of texts that give a list of its parts."""
OPERATED: Final = SET_OPERATORS | {"+", "*"}
_ELEMENT: Final = "#element"
"""Stands for an element where a function is called with each; no variable has such a name."""
MAX_ITEMS = 256
"""Elements of a list that are looked at one by one."""
_Giver: TypeAlias = "Callable[[ListFolder, Invocation, Env], list[Bound] | None]"


def _row(*parts: Bound) -> Bound:
    """A tuple of elements that are evaluated in different places."""
    names = [f"#{index}" for index in range(len(parts))]
    place = parts[0].env
    state = State().having(
        {name: (Held("value", name, part.expr, part.env),) for name, part in zip(names, parts, strict=True)}
    )
    return Bound(Items(tuple([Name(name) for name in names])), place.within(state, place.at))


def operated(lists: ListFolder, expr: Op, env: Env) -> list[Bound] | None:
    """Return the elements of `a + b`, and of Python of `[x] * 3` and of `a | b`; None when not all are known."""
    if expr.op in SET_OPERATORS:
        return set_by_operator(lists, expr, env) if env.func.file.language == "python" else None
    parts = [lists.items(operand, env) for operand in expr.operands]
    if expr.op == "+":
        return [*parts[0], *parts[1]] if parts[0] is not None and parts[1] is not None else None
    at = 0 if parts[0] is not None else 1
    items = parts[at]
    if items is None or env.func.file.language != "python":
        return None
    count = [data_in(value) for value in lists.folder.fold(expr.operands[1 - at], env) if is_proved(value)]
    known = len(count) == 1 and isinstance(count[0], int) and not isinstance(count[0], bool)
    return items * count[0] if known and 0 <= count[0] * len(items) <= MAX_ITEMS else None


def _range(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    values = [lists.folder.fold(arg, env) for arg in call.args]
    known = [found[0].data for found in values if len(found) == 1 and is_proved(found[0])]
    data = [entry for entry in known if isinstance(entry, int)]
    if not 1 <= len(data) <= 3 or len(data) != len(values) or 0 in data[2:]:
        return None
    numbers = range(*data)
    return [Bound(Number(number), env) for number in numbers] if len(numbers) <= MAX_ITEMS else None


def _copied(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    if not call.args:
        return []
    return lists.items(call.args[0], env) if len(call.args) == 1 and not call.keywords else None


def _sorted(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    keywords = dict(call.keywords)
    plain = len(call.args) == 1 and not keywords.keys() - {"key"}
    items = lists.in_any_order(call.args[0], env) if plain else None
    if items is None or "key" not in keywords:
        return None if items is None else lists.folder.list_changes.ordered(items)
    keys = [_applied(lists, keywords["key"], item, env) for item in items]
    return lists.folder.list_changes.ordered_by(items, [key for key in keys if key is not None])


def _mapped(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    items = lists.items(call.args[1], env) if len(call.args) == 2 and not call.keywords else None
    if items is None:
        return None
    given = [_applied(lists, call.args[0], item, env) for item in items]
    known = [bound for bound in given if bound is not None]
    return known if len(known) == len(given) else None


def _applied(lists: ListFolder, function: Expr, item: Bound, env: Env) -> Bound | None:
    """What a function gives for an element; None of a lambda that takes something else."""
    if isinstance(function, Lambda):
        plain = function.body is not None and len(function.params) == 1 and function.params[0].isidentifier()
        if function.body is None or not plain:
            return None
        return Bound(function.body, lists.folder.flow.naming(env, {function.params[0]: item}))
    place = lists.folder.flow.naming(env, {_ELEMENT: item})
    return Bound(Call(function, (Name(_ELEMENT),)), place) if isinstance(function, Name) else None


def _reversed(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    items = _copied(lists, call, env)
    return None if items is None else items[::-1]


def _enumerated(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    start = next(
        (value for name, value in call.keywords if name == "start"), call.args[1] if len(call.args) > 1 else Number(0)
    )
    items = lists.items(call.args[0], env) if call.args else None
    if items is None or not isinstance(start, Number) or not isinstance(start.value, int):
        return None
    return [_row(Bound(Number(start.value + index), env), item) for index, item in enumerate(items)]


def _zipped(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    columns = [lists.items(arg, env) for arg in call.args]
    known = [column for column in columns if column is not None]
    if len(known) != len(columns) or not columns or call.keywords:
        return None
    return [_row(*row) for row in zip(*known, strict=False)]


def _columns(lists: ListFolder, call: Invocation, env: Env) -> list[list[Bound]] | None:
    columns = [lists.items(arg, env) for arg in call.args]
    known = [column for column in columns if column is not None]
    return known if len(known) == len(columns) and columns else None


def _producted(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    columns, keywords = _columns(lists, call, env), dict(call.keywords)
    count = keywords.get("repeat", Number(1))
    if columns is None or keywords.keys() - {"repeat"} or not isinstance(count, Number) or count.value not in range(9):
        return None
    columns = columns * int(count.value)
    if not columns or prod(map(len, columns)) > MAX_ITEMS:
        return None
    return [_row(*row) for row in product(*columns)]


def _chained(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    columns = _columns(lists, call, env) if not call.keywords else None
    return [each for column in columns for each in column] if columns is not None else None


def _flattened(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    rows = lists.items(call.args[0], env) if len(call.args) == 1 and not call.keywords else None
    columns = [lists.items(row.expr, row.env.deeper(env.depth + 1)) for row in rows or ()]
    known = [column for column in columns if column is not None]
    return [each for column in known for each in column] if rows is not None and len(known) == len(columns) else None


def _zipped_longest(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    columns, keywords = _columns(lists, call, env), dict(call.keywords)
    if columns is None or keywords.keys() - {"fillvalue"}:
        return None
    fill = Bound(keywords.get("fillvalue", Constant("null")), env)
    return [_row(*row) for row in zip_longest(*columns, fillvalue=fill)]


def _chosen(work: Callable[[list[Bound], int], Iterable[tuple[Bound, ...]]]) -> _Giver:
    def give(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
        items = lists.items(call.args[0], env) if len(call.args) == 2 and not call.keywords else None
        size = call.args[1] if items is not None else None
        if items is None or not isinstance(size, Number) or size.value not in range(1, 9):
            return None
        rows = list(islice(work(items, int(size.value)), MAX_ITEMS + 1))
        return [_row(*row) for row in rows] if len(rows) <= MAX_ITEMS else None

    return give


def _table_part(which: str) -> _Giver:
    def work(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
        entries = lists.folder.tables.entries(call.receiver, env)
        distinct = lists.folder.tables.distinct(entries, env) if entries is not None else None
        if distinct is None:
            return None
        if which == "items":
            return [_row(entry.key, entry.value) for entry in distinct]
        return [entry.key if which == "keys" else entry.value for entry in distinct]

    return work


def _keys_of_made(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    return lists.folder.tables.keys(Call(Name(call.path), call.args, call.keywords), env)


def _split(lists: ListFolder, call: Invocation, env: Env) -> list[Bound] | None:
    if call.receiver is None:
        return None
    groups = [lists.folder.fold(part, env) for part in (call.receiver, *call.args)]
    if any(len(group) != 1 or not is_proved(group[0]) for group in groups):
        return None
    data = [data_in(group[0]) for group in groups]
    found = method(call.last, data[0], data[1:], True) if isinstance(data[0], str) and UNKNOWN not in data else UNKNOWN
    return [Bound(Text(part), env) for part in found] if isinstance(found, list | tuple) else None


LIST_CALLS: Final[Mapping[str, _Giver]] = MappingProxyType(
    {
        "range": _range,
        "list": _copied,
        "tuple": _copied,
        "set": set_of,
        "frozenset": set_of,
        **dict.fromkeys(SET_METHODS, set_by_method),
        "copy": lambda lists, call, env: lists.items(call.receiver, env) if not call.args else None,
        "map": _mapped,
        "sorted": _sorted,
        "reversed": _reversed,
        "enumerate": _enumerated,
        "zip": _zipped,
        "itertools.product": _producted,
        "itertools.chain": _chained,
        "itertools.chain.from_iterable": _flattened,
        "itertools.zip_longest": _zipped_longest,
        "itertools.combinations": _chosen(combinations),
        "itertools.permutations": _chosen(permutations),
        **dict.fromkeys(MAKERS, _keys_of_made),
        "collections.deque": _copied,
        **dict.fromkeys(asking(), asked_together),
        "keys": _table_part("keys"),
        "values": _table_part("values"),
        "items": _table_part("items"),
        **dict.fromkeys(SPLITS, _split),
    }
)
"""Calls of Python that give lists, as functions or as methods."""
ORDERLESS: Final = SET_METHODS | {"set", "frozenset", "list", "tuple", "copy", "map", "sorted"}
"""Those that ask no more of the order of what they get than who asks them."""
