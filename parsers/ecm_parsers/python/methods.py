"""Methods and builtin functions that files call on values they build.

Only what neither runs code nor grows without bound; everything else is unknown.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from ecm_parsers.expression_limits import ExpressionError, check_growth
from ecm_parsers.expression_names import FUNCTIONS, METHODS
from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.formats import as_formatted, formatted
from ecm_parsers.python.library import joined_path
from ecm_parsers.python.operators import truth
from ecm_parsers.python.values import (
    MAX_ITEMS,
    Many,
    Modelled,
    Reference,
    Text,
    Unknown,
    Value,
    as_str,
    hashable,
    is_counted,
    is_plain,
    is_yaml_file,
    merged_text,
    template_of,
)
from ecm_parsers.template import Substitution, Template

_OF_COUNTED: Mapping[str, Callable[..., Value]] = MappingProxyType(
    {
        "pop": list.pop,
        "remove": list.remove,
        "sort": lambda items: items.sort(),
        "reverse": list.reverse,
        "clear": list.clear,
        "count": list.count,
        "__setitem__": list.__setitem__,
        "__delitem__": list.__delitem__,
    }
)
"""Methods of a list that are known where all its elements are."""
_COMPARING = frozenset({"count", "remove"})
_VIEWS: Mapping[str, Callable[[dict[Value, Value]], Value]] = MappingProxyType(
    {
        "items": lambda table: [_like(key, value) for key, value in table.items()],
        "keys": list,
        "values": lambda table: [Many(value) if isinstance(key, Many) else value for key, value in table.items()],
    }
)
LOSING = frozenset({"pop", "remove", "sort", "reverse", "clear", "__delitem__"})
"""Methods of lists and maps that take something from them, or move it."""
READING = frozenset({"get", "copy", "index", "count", *_VIEWS})
"""Methods of lists and maps that leave them as they are."""
_SAME = frozenset(
    {
        "read",
        "toxml",
        "toprettyxml",
        "perform",
        "resolve",
        "as_posix",
        "absolute",
        "strip",
        "lstrip",
        "rstrip",
        "expanduser",
        "copy",
    }
)


def call_method(owner: Value, name: str, given: Arguments) -> Value:
    """Return what a method of a value gives; lists, dicts and objects of libraries change in place."""
    if isinstance(owner, Modelled):
        return owner.call(name, given)
    if isinstance(owner, list):
        return _of_list(owner, name, given)
    if isinstance(owner, dict):
        return _of_dict(owner, name, given)
    if isinstance(owner, str):
        return _of_text(owner, name, given)
    if isinstance(owner, Text):
        return _of_template(owner, name, given)
    return Unknown(name)


def _of_list(owner: list[Value], name: str, given: Arguments) -> Value:
    first = given.get("", 0)
    if name == "append":
        owner.append(first)
    elif name == "extend" and isinstance(first, list | tuple):
        owner.extend(first)
    elif name == "insert" and len(given.positional) == 2 and isinstance(first, int):
        owner.insert(max(min(first, len(owner)), -len(owner)), given.positional[1])
    elif name == "copy":
        return list(owner)
    elif name == "index" and is_counted(owner):
        return next((at for at, item in enumerate(owner) if item is first or item == first), Unknown("index"))
    elif (
        name in _OF_COUNTED
        and is_counted(owner)
        and not (name in _COMPARING and any(map(_is_open, owner)))
        and not given.keywords
    ):
        try:
            return _OF_COUNTED[name](owner, *given.positional)
        except (TypeError, ValueError, IndexError):
            return Unknown(name)
    else:
        return Unknown(name)
    return None


def _is_open(item: Value) -> bool:
    return isinstance(item, Text | Unknown | Reference)


def _of_dict(owner: dict[Value, Value], name: str, given: Arguments) -> Value:
    first = given.get("", 0)
    if name == "get":
        return owner.get(first, otherwise_in(owner, given.get("default", 1))) if hashable(first) else Unknown("get")
    if name == "update":
        return _updated(owner, first, given)
    if name == "__setitem__" and hashable(first) and len(owner) < MAX_ITEMS:
        put(owner, first, given.positional[1])
        return None
    if name == "setdefault" and hashable(first):
        return owner.setdefault(first, otherwise_in(owner, given.get("default", 1)))
    if name in {"pop", "__delitem__"} and hashable(first) and is_counted(owner):
        return owner.pop(first, given.get("", 1, Unknown(name)))
    if name in _VIEWS:
        return _VIEWS[name](owner)
    return dict(owner) if name == "copy" else Unknown(name)


def otherwise_in(owner: dict[Value, Value], otherwise: Value) -> Value:
    """Return what a map gives for a key that it does not show: it may have it all the same."""
    return otherwise if is_counted(owner) else Unknown("item")


def put(owner: dict[Value, Value], key: Value, value: Value) -> None:
    """Set an entry of a map; one that was there perhaps is there."""
    owner.pop(Many(key), None)
    owner[key] = value


def _like(key: Value, value: Value) -> Value:
    return Many((key.each, value)) if isinstance(key, Many) else (key, value)


def _updated(owner: dict[Value, Value], more: Value, given: Arguments) -> Value:
    table = more if isinstance(more, dict) else {more: more} if is_yaml_file(more) else {}
    for key, value in (*table.items(), *given.keywords.items()):
        put(owner, key, value)
    return None if isinstance(more, dict) or not given.positional or is_yaml_file(more) else Unknown("update")


def _of_text(owner: str, name: str, given: Arguments) -> Value:
    if name == "format":
        return formatted(owner, given)
    if name == "join":
        return _joined(owner, given.get("", 0))
    if name in METHODS[str] and is_plain(given.positional):
        try:
            check_growth(name, owner, list(given.positional))
            return getattr(owner, name)(*given.positional, **given.keywords)
        except (ExpressionError, TypeError, ValueError, LookupError):
            return Unknown(name)
    return owner if name in _SAME else Unknown(name)


def _joined(between: str, items: Value) -> Value:
    if not isinstance(items, list | tuple | dict):
        return Unknown("join")
    parts: Template = ()
    for at, item in enumerate(items):
        parts = (*parts, *(template_of(between) if at else ()), *template_of(item))
    return merged_text(parts, is_str=True)


def _of_template(owner: Text, name: str, given: Arguments) -> Value:
    if name == "lower":
        return Text((Substitution("lower", (owner.parts,)),), is_str=True)
    if name == "joinpath":
        return joined_path((owner, *given.positional))
    if name == "perform":
        return as_str(owner)
    return owner if name in _SAME else Unknown(name)


def call_builtin(name: str, given: Arguments) -> Value:
    """Return what a builtin function gives."""
    function = _OWN.get(name) or (FUNCTIONS[name] if name in _OF_ITEMS or name in _OF_PLAIN else None)
    if function is None or (name in _OF_PLAIN and not is_plain(given.positional)):
        return Unknown(name)
    if name not in _OF_ANY and any(isinstance(each, _HOLDING) and not is_counted(each) for each in given.positional):
        return Unknown(name)
    try:
        return function(*given.positional, **given.keywords)
    except (ExpressionError, ArithmeticError, LookupError, TypeError, ValueError):
        return Unknown(name)


def _table(items: Value = (), **entries: Value) -> Value:
    if isinstance(items, dict):
        return {**items, **entries}
    pairs = [(Many(each.each[0]), each.each[1]) if isinstance(each, Many) else each for each in items]
    return dict(pairs, **entries)


def _text(value: Value = "") -> Value:
    return merged_text(as_formatted(value, ""), is_str=True)


def _number(kind: type) -> Callable[[Value], Value]:
    return lambda value: Text(value.parts, value.is_str) if isinstance(value, Text) else kind(value)


def _bool(value: Value = False) -> Value:  # as Python has it
    holds = truth(value)
    return holds if isinstance(holds, bool) else Text(holds)


_OWN: Mapping[str, Callable[..., Value]] = MappingProxyType(
    {"str": _text, "int": _number(int), "float": _number(float), "bool": _bool, "dict": _table}
)
_HOLDING = (list, tuple, dict)
_OF_ANY = frozenset({"list", "tuple", "set", "dict", "str", "bool"})
"""Functions that make something of a list that has more elements than are known."""
_OF_ITEMS = frozenset({"len", "min", "max", "sorted", "reversed", "list", "tuple", "set", "range", "zip", "enumerate"})
"""Functions of what holds values, whatever these are."""
_OF_PLAIN = frozenset({"abs", "all", "any", "divmod", "ord", "repr", "round", "sum"})
"""Functions of values that are wholly known."""
