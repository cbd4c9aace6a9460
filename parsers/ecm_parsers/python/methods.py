"""Methods and builtin functions that files call on values they build.

Only what neither runs code nor grows without bound; everything else is unknown.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

from ecm_parsers.python.arguments import Arguments
from ecm_parsers.python.library import joined_path
from ecm_parsers.python.values import (
    MAX_ITEMS,
    Modelled,
    Text,
    Unknown,
    Value,
    as_str,
    is_yaml_file,
    merged_text,
    template_of,
)
from ecm_parsers.template import Substitution

_MAX_INDEX = 6
"""Digits of an index that are read: no call has as many arguments."""
_FIELD = re.compile(r"\{(\w*)(?:[:!][^{}]*)?\}")
_PERCENT = re.compile(r"%[-#0 +]*\d*(?:\.\d+)?[sdifgrx]")
_PLAIN_TEXT: Mapping[str, Callable[..., Value]] = MappingProxyType(
    {
        "lower": str.lower,
        "upper": str.upper,
        "strip": str.strip,
        "lstrip": str.lstrip,
        "rstrip": str.rstrip,
        "capitalize": str.capitalize,
        "title": str.title,
        "startswith": str.startswith,
        "endswith": str.endswith,
        "replace": str.replace,
        "split": str.split,
        "splitlines": str.splitlines,
        "isdigit": str.isdigit,
    }
)
_VIEWS: Mapping[str, Callable[[dict[Value, Value]], Value]] = MappingProxyType(
    {"items": lambda table: list(table.items()), "keys": list, "values": lambda table: list(table.values())}
)
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
    elif name == "index":
        return next((at for at, item in enumerate(owner) if item is first or item == first), Unknown("index"))
    return None


def _of_dict(owner: dict[Value, Value], name: str, given: Arguments) -> Value:
    first = given.get("", 0)
    if name == "get":
        return owner.get(first, given.get("default", 1)) if hashable(first) else Unknown("get")
    if name == "update":
        owner.update(first if isinstance(first, dict) else {first: first} if is_yaml_file(first) else {})
        owner.update(given.keywords)
        return None
    if name == "setdefault" and hashable(first):
        return owner.setdefault(first, given.get("default", 1))
    if name in _VIEWS:
        return _VIEWS[name](owner)
    return dict(owner) if name == "copy" else Unknown(name)


def _of_text(owner: str, name: str, given: Arguments) -> Value:
    if name == "format":
        return formatted(owner, given)
    if name == "join":
        items = given.get("", 0, ())
        between = template_of(owner)
        parts: tuple[str | Substitution, ...] = ()
        for at, item in enumerate(items if isinstance(items, list | tuple) else ()):
            parts = (*parts, *(between if at else ()), *template_of(item))
        return merged_text(parts, is_str=True)
    if name in _PLAIN_TEXT and all(isinstance(value, str | int) for value in given.positional):
        try:
            return _PLAIN_TEXT[name](owner, *given.positional)
        except (TypeError, ValueError):
            return Unknown(name)
    return owner if name in _SAME else Unknown(name)


def _of_template(owner: Text, name: str, given: Arguments) -> Value:
    if name == "lower":
        return Text((Substitution("lower", (owner.parts,)),), is_str=True)
    if name == "joinpath":
        return joined_path((owner, *given.positional))
    if name == "perform":
        return as_str(owner)
    return owner if name in _SAME else Unknown(name)


def formatted(text: str, given: Arguments) -> Value:
    """Return `text.format(...)` as text with substitutions; a field that nothing fills stays."""
    positional = iter(given.positional)
    parts: list[str | Substitution] = []
    position = 0
    for match in _FIELD.finditer(text):
        parts.append(text[position : match.start()])
        position = match.end()
        parts.extend(_filled(match, given, positional.__next__))
    parts.append(text[position:])
    return merged_text(tuple(parts), is_str=True)


def _filled(match: re.Match[str], given: Arguments, following: Callable[[], Value]) -> tuple[str | Substitution, ...]:
    key = match[1]
    try:
        if not key:
            return template_of(following())
        if key.isdecimal():
            return template_of(given.positional[int(key[:_MAX_INDEX])])
        return template_of(given.keywords[key])
    except (StopIteration, IndexError, KeyError):
        return (match[0],)


def percent_formatted(text: str, value: Value) -> Value:
    """Return `text % value` as text with substitutions."""
    values = list(value) if isinstance(value, tuple) else [value]
    parts: list[str | Substitution] = []
    position = 0
    for match in _PERCENT.finditer(text):
        parts.append(text[position : match.start()])
        position = match.end()
        parts.extend(template_of(values.pop(0)) if values else (match[0],))
    parts.append(text[position:])
    return merged_text(tuple(parts), is_str=True)


def call_builtin(name: str, given: Arguments) -> Value:
    """Return what a builtin function gives."""
    maker = _BUILTINS.get(name)
    if maker is None or not given.positional:
        return _EMPTY[name]() if name in _EMPTY and not given.positional else Unknown(name)
    try:
        return maker(*given.positional)
    except (TypeError, ValueError, OverflowError, KeyError):
        return Unknown(name)


def hashable(value: Value) -> bool:
    """Tell whether a value can be a key."""
    return isinstance(value, str | int | float | bool | Text | None) or (
        isinstance(value, tuple) and all(hashable(item) for item in value)
    )


def _as_text(value: Value) -> Value:
    return merged_text(template_of(value), is_str=True)


def _range(*bounds: int) -> Value:
    found = range(*bounds)
    return list(found) if len(found) <= MAX_ITEMS else Unknown("range")


def _number(kind: Callable[[Value], Value]) -> Callable[[Value], Value]:
    return lambda value: Text(value.parts, value.is_str) if isinstance(value, Text) else kind(value)


_EMPTY: Mapping[str, Callable[[], Value]] = MappingProxyType(
    {"list": list, "dict": dict, "tuple": tuple, "str": str, "set": list}
)
_BUILTINS: Mapping[str, Callable[..., Value]] = MappingProxyType(
    {
        "str": _as_text,
        "int": _number(int),
        "float": _number(float),
        "bool": _number(bool),
        "len": len,
        "list": list,
        "tuple": tuple,
        "dict": dict,
        "set": list,
        "range": _range,
        "enumerate": lambda items: list(enumerate(items)),
        "zip": lambda *items: list(zip(*items, strict=False)),
        "sorted": lambda items: sorted(items),
        "reversed": lambda items: list(reversed(items)),
        "min": min,
        "max": max,
        "abs": abs,
        "round": round,
    }
)
