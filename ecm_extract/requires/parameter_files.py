"""Parameter files: the parameters that they set, the plugins and frames that their values name."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Final

import msgspec
from ecm_checker.finding import Certainty
from ecm_checker.hub.requirement import Requirement
from ecm_parsers.parameter_yaml import ParameterSet, node_keys, parse_parameter_yaml

from ecm_extract.read.facts import PackageFacts
from ecm_extract.requires.launch_files import MANAGED
from ecm_extract.requires.place import Place, required
from ecm_extract.test_code import is_test_path
from ecm_extract.tree import Tree

ROS2: Final = 2
_YAML: Final = (".yaml", ".yml")
_TYPES: Final = {"int": "integer", "int_array": "integer_array"}
_ANY_NODE: Final = frozenset({None, "/**", "/*"})
_CLASS: Final = re.compile(r"[A-Za-z_]\w*(?:(?:::|/)[A-Za-z_]\w*)+")
"""A name that a plugin is looked up by."""
_PLUGIN: Final = "plugin"
"""Key of a block that is the configuration of a plugin (nav2, `declare_parameter(name + ".plugin")`)."""
_NAMES_FRAME: Final = re.compile(r"(?:frame|frame_id|link)s?$")
_PLAIN: Final = (str, int, float, bool)
MAX_VALUE: Final = 200


def parameter_file_requirements(tree: Tree, facts: PackageFacts) -> Iterator[Requirement]:
    """Yield what the YAML files of a package require; those of tests are left out."""
    paths = [
        entry.path
        for entry in facts.root.files
        if entry.path.endswith(_YAML) and not is_test_path(entry.path, facts.root.path)
    ]
    for path, data in tree.read_many(sorted(paths)):
        file = parse_parameter_yaml(data).facts
        for key in node_keys(data) if file.ros == ROS2 else ():
            yield required("keys_parameters", key.name, Place(path, key.line, f"file {path}"), ros=ROS2)
        plugins = _plugins(file.sets)
        for entry in file.sets:
            for found in _of_set(entry, file.ros, path):
                plugin = _plugin_of(entry, plugins)
                yield msgspec.structs.replace(found, plugin=plugin) if plugin else found


def _plugins(entries: Iterable[ParameterSet]) -> Mapping[tuple[str | None, str], str]:
    """The classes that blocks name: `local.layer: {plugin: "arm_lib::Layer"}` by node and `local.layer`."""
    found: dict[tuple[str | None, str], str] = {}
    for entry in entries:
        block, dot, last = entry.name.rpartition(".")
        if dot and last == _PLUGIN and isinstance(entry.value, str) and _CLASS.fullmatch(entry.value):
            found[entry.node, block] = entry.value
    return found


def _plugin_of(entry: ParameterSet, plugins: Mapping[tuple[str | None, str], str]) -> str:
    """The class of the nearest block around a parameter that names one; empty without any."""
    block = entry.name
    while plugins and "." in block:
        block = block.rpartition(".")[0]
        if (entry.node, block) in plugins:
            return plugins[entry.node, block]
    return ""


def _of_set(entry: ParameterSet, ros: int, path: str) -> Iterator[Requirement]:
    place = Place(path, entry.line, f"file {path}", entry.column or None)
    certainty: Certainty = "likely" if entry.node in _ANY_NODE else "proved"
    yield required(
        "sets_parameter",
        entry.name,
        place,
        certainty,
        owner=entry.node or "",
        type=_TYPES.get(entry.type, entry.type),
        value=_short(entry.value),
        ros=ros,
    )
    for text in _texts(entry.value) if entry.name.endswith(MANAGED) and isinstance(entry.value, list) else ():
        yield required("manages", text.strip("/"), place)
    for text in _texts(entry.value):
        words = text.split()  # a list of plugins may be one text
        if all(_CLASS.fullmatch(word) for word in words):
            yield from (required("loads_plugin", word, place) for word in words)
        if _NAMES_FRAME.search(entry.name):
            yield required("names_frame", text, place, "likely", said=entry.name)


def _short(value: Any) -> Any:
    """A value that is worth keeping: of a long text or a nested one only its type counts."""
    return value if isinstance(value, _PLAIN) and len(str(value)) <= MAX_VALUE else None


def _texts(value: Any) -> Iterator[str]:
    items = value if isinstance(value, list) else [value]
    return (item for item in items if isinstance(item, str))
