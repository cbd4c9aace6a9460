"""What a reader of Python files knows of the libraries that these call."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import msgspec

from ecm_parsers.python.arguments import Constructor
from ecm_parsers.python.values import Value

_NOTHING: Mapping[str, Constructor] = MappingProxyType({})


class Models(msgspec.Struct, frozen=True):
    """What calls of libraries mean, in rows.

    Attributes:
        calls: what a function or a class makes, by the last part of its name.
        tables: what the item of a table of a library is, by the last part of the name of the table.
        loaders: functions that read a module from a path, and at which position the path stands.
        constants: values by their dotted names.
        outside: packages whose modules are not read, wherever their source lies.
    """

    calls: Mapping[str, Constructor]
    tables: Mapping[str, Constructor] = _NOTHING
    loaders: Mapping[str, int] = MappingProxyType({})
    constants: Mapping[str, Value] = MappingProxyType({})
    outside: frozenset[str] = frozenset()
