"""What a Python file learns from other files while it is read: data, names, whether they are there."""

from __future__ import annotations

from fnmatch import fnmatchcase

from ecm_parsers.python.library import joined_path
from ecm_parsers.python.sources import Sources
from ecm_parsers.python.values import MAX_ITEMS, Text, Unknown, Value, is_yaml_file, template_of
from ecm_parsers.template import Substitution
from ecm_parsers.yaml_scalar import typed_by_pyyaml
from ecm_parsers.yaml_tree import parse_yaml, plain

MAX_BYTES = 500_000


def loaded(sources: Sources, value: Value) -> Value:
    """Return the data of a YAML file that is named by a value, the value itself where there is none to read."""
    if not isinstance(value, Text) or not is_yaml_file(value):
        return value
    (part,) = value.parts
    data = sources.file(part.args[0]) if isinstance(part, Substitution) else None
    documents = parse_yaml(data, typed_by_pyyaml).facts if data is not None and len(data) <= MAX_BYTES else ()
    return plain(documents[0]) if documents else value


def exists(sources: Sources, path: Value) -> Value:
    """Return whether a file is in the tree, Unknown for a path outside of it."""
    found = sources.exists(template_of(path))
    return Unknown("exists") if found is None else found


def globbed(sources: Sources, folder: Value, pattern: Value) -> Value:
    """Return the files of a folder whose names fit a pattern."""
    names = sources.names(template_of(folder))
    if names is None or not isinstance(pattern, str):
        return Unknown("glob")
    return [joined_path((folder, name)) for name in names if fnmatchcase(name, pattern)][:MAX_ITEMS]
