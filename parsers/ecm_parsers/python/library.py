"""What functions of Python's own library, and of what reads YAML, make of texts that are not wholly known.

Source: docs.python.org, `os`, `os.path`, `pathlib`, `math`; PyYAML.
"""

from __future__ import annotations

import math
import posixpath
from collections.abc import Mapping
from types import MappingProxyType

from ecm_parsers.python.arguments import Arguments, Constructor
from ecm_parsers.python.values import Many, Text, Unknown, Value, as_str, merged_text, template_of
from ecm_parsers.template import Substitution, Template


def substituted(kind: str, *args: Template) -> Text:
    """Return a text that is one substitution."""
    return Text((Substitution(kind, args),))


def of_one(kind: str, name: str) -> Constructor:
    """What is made of one argument."""
    return lambda given: substituted(kind, given.template(name, 0))


def with_default(kind: str, name: str, default: str) -> Constructor:
    """What is made of a name, and of what stands for it where nothing has it."""

    def make(given: Arguments) -> Value:
        otherwise = given.optional(default, 1)
        return substituted(kind, given.template(name, 0), *(() if otherwise is None else (otherwise,)))

    return make


def joined_path(items: tuple[Value, ...]) -> Value:
    """Return parts of a path joined by `/`; an absolute part discards those before it."""
    parts: list[str | Substitution] = []
    for item in items:
        current = template_of(item)
        if current and isinstance(current[0], str) and current[0].startswith("/"):
            parts = list(current)
            continue
        if parts and not (isinstance(parts[-1], str) and parts[-1].endswith("/")):
            parts.append("/")
        parts.extend(current)
    return merged_text(tuple(parts))


def _os_path_join(given: Arguments) -> Value:
    return joined_path(given.positional)


def _parent(given: Arguments) -> Value:
    parts = template_of(given.get("path", 0))
    if parts and isinstance(parts[-1], str) and "/" in parts[-1]:
        return merged_text((*parts[:-1], parts[-1].rsplit("/", 1)[0]))
    return merged_text((*parts, "/.."))


def _basename(given: Arguments) -> Value:
    parts = given.template("path", 0)
    if parts and isinstance(parts[-1], str) and ("/" in parts[-1] or len(parts) == 1):
        name = parts[-1].rsplit("/", 1)[-1]
        return Unknown("basename") if name == ".." else name
    return Unknown("basename")


def _splitext(given: Arguments) -> Value:
    parts = given.template("p", 0)
    if not parts or not isinstance(parts[-1], str):
        return Unknown("splitext")
    stem, suffix = posixpath.splitext(parts[-1])
    return merged_text((*parts[:-1], stem)), suffix


def _glob(given: Arguments) -> Value:
    """Any number of files, whose names are like the pattern."""
    return [Many(substituted("files", given.template("pathname", 0)))]


def _yaml(given: Arguments) -> Value:
    """What a YAML file holds is named by its path, which is what readers of parameters look for."""
    value = given.get("stream", 0)
    parts = value.parts if isinstance(value, Text) else ()
    if len(parts) == 1 and isinstance(parts[0], Substitution) and parts[0].kind == "file":
        return substituted("yaml", *parts[0].args)
    return Text(value.parts, value.is_str) if isinstance(value, Text) else value


def _same(given: Arguments) -> Value:
    return given.get("", 0)


LIBRARY: Mapping[str, Constructor] = MappingProxyType(
    {
        "getenv": lambda given: as_str(with_default("env", "key", "default")(given)),
        "open": of_one("file", "file"),
        "safe_load": _yaml,
        "full_load": _yaml,
        "Path": _os_path_join,
        "join": _os_path_join,
        "dirname": _parent,
        "basename": _basename,
        "splitext": _splitext,
        "glob": _glob,
        "iglob": _glob,
        "abspath": _same,
        "realpath": _same,
        "normpath": _same,
        "expanduser": _same,
    }
)
"""By the last part of the name of a function."""
CONSTANTS: Mapping[str, Value] = MappingProxyType(dict.fromkeys(("pi", "math.pi", "numpy.pi"), math.pi))
"""By the dotted name; a name alone is that of `from math import *`."""
TABLES: Mapping[str, Constructor] = MappingProxyType({"environ": LIBRARY["getenv"]})
"""What an item of a table is, by the last part of its name."""
LOADERS: Mapping[str, int] = MappingProxyType({"SourceFileLoader": 1, "spec_from_file_location": 1})
"""Functions that read a module from a path, and at which position the path stands."""
