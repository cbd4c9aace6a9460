"""Any value of a contract as data that JSON and YAML hold alike, and that is the same on every run.

Free-form values come from other people's files: keys that are no strings, numbers beyond every range, half
surrogates, nesting without end. They are made into text here, once, so that no writer can fail on them.
"""

from __future__ import annotations

import math
from functools import cache
from operator import itemgetter
from typing import Any, Final

import msgspec

_LARGEST: Final = 2**63
_DEEPEST: Final = 64
_CUT: Final = "..."


def json_data(value: object, depth: int = 0) -> Any:
    """Plain JSON data of a record or free-form value.

    Records keep the order of their fields and leave out what equals a default when they say so
    (`omit_defaults`); keys of mappings and items of sets are sorted. What is nested
    deeper than 64 levels is cut.
    """
    if depth > _DEEPEST:
        return _CUT
    match value:
        case str():
            return _text(value)
        case None | bool():
            return value
        case int():
            return value if -_LARGEST <= value < _LARGEST else hex(value)
        case float():
            return value if math.isfinite(value) else repr(value)
        case msgspec.Struct():
            return record_data(value, depth)
        case dict():
            return {key: json_data(item, depth + 1) for key, item in sorted(_keyed(value), key=itemgetter(0))}
        case list() | tuple():
            return [json_data(item, depth + 1) for item in value]
        case set() | frozenset():
            return sorted((json_data(item, depth + 1) for item in value), key=repr)
    return _text(str(value))


def record_data(record: msgspec.Struct, depth: int = 0) -> dict[str, Any]:
    """Plain JSON data of a record, see `json_data`; one of several kinds begins with the word for its kind."""
    omitted = _omitted(type(record))
    pairs = ((name, getattr(record, name)) for name in record.__struct_fields__)
    data = {name: json_data(item, depth + 1) for name, item in pairs if name not in omitted or item != omitted[name]}
    return {**_kind(type(record)), **data}


def _text(value: str) -> str:
    return value if value.isascii() else value.encode("utf-8", "replace").decode("utf-8")


def _keyed(mapping: dict[Any, Any]) -> list[tuple[str, Any]]:
    return [(_text(key if isinstance(key, str) else str(key)), item) for key, item in mapping.items()]


@cache
def _kind(record: type[msgspec.Struct]) -> dict[str, Any]:
    config = record.__struct_config__
    return {} if config.tag_field is None else {config.tag_field: config.tag}


@cache
def _omitted(kind: type[msgspec.Struct]) -> dict[str, object]:
    """Defaults that are not written, by field."""
    if not kind.__struct_config__.omit_defaults:
        return {}
    fields = msgspec.structs.fields(kind)
    return {field.name: field.default for field in fields if field.default is not msgspec.NODEFAULT}
