"""Parameter files: ROS 1 (`rosparam load`) and ROS 2 (`--params-file`).

Source: ROS 1 Parameter Server naming; ROS 2 `rcl_yaml_param_parser` (`node: ros__parameters:`, `/**`, `*`).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, Literal

import msgspec

from ecm_parsers.result import Diagnostic, Parsed
from ecm_parsers.rosparam_angles import of_rosparam, typed_by_rosparam
from ecm_parsers.yaml_tree import Entry, Mapping, Node, Scalar, Sequence, parse_yaml, plain

MARKER = "ros__parameters"
MAX_NAMESPACES = 12
MAX_NAME = 500
"""Nested keys are joined for each leaf, so long ones would multiply."""
_TYPES = {bool: "bool", int: "int", float: "double", str: "string", type(None): "null"}


class ParameterSet(msgspec.Struct, frozen=True):
    """One parameter that a file sets.

    Attributes:
        node: ROS 2 node name or pattern, absolute (`/ns/node`, `/**`); None in a ROS 1 file.
        name: `a/b/c` in a ROS 1 file, `a.b.c` in a ROS 2 file.
        value: plain data; launch substitutions such as `$(var x)` stay text.
        type: bool, int, double, string, null, a typed array (`double_array`), `array` when mixed, or `map`.
        line: 1-based line of the last key. column: 1-based column of it, 0 where it is not known.
    """

    node: str | None
    name: str
    value: Any
    type: str
    line: int
    column: int = 0


class ParameterFile(msgspec.Struct, frozen=True):
    """What a parameter file sets; `ros` tells which form it has."""

    ros: Literal[1, 2]
    sets: tuple[ParameterSet, ...] = ()


class NodeKey(msgspec.Struct, frozen=True):
    """The key of a file that names a node; `line` is 1-based."""

    name: str
    line: int


def node_keys(data: bytes) -> tuple[NodeKey, ...]:
    """Return the names of nodes that a parameter file of ROS 2 is keyed by, without their namespaces and patterns."""
    maps = (document for document in parse_yaml(data).facts if isinstance(document, Mapping))
    return tuple(key for document in maps for key in _node_keys(document))


def _node_keys(namespace: Mapping) -> Iterator[NodeKey]:
    for entry in namespace.entries:
        if not isinstance(entry.value, Mapping) or not _has_marker(entry.value):
            continue
        name = entry.key.strip("/").rpartition("/")[2]
        if entry.value.get(MARKER) is not None and "*" not in name:
            yield NodeKey(name, entry.line)
        yield from _node_keys(entry.value)


def parse_parameter_yaml(data: bytes) -> Parsed[ParameterFile]:
    """Read a parameter file of ROS 1 or ROS 2; it is of ROS 2 when a `ros__parameters` key is present.

    Values are typed as the reader of each does it: PyYAML in ROS 1, `rcl_yaml_param_parser` in ROS 2.
    """
    tree = parse_yaml(data)
    if not any(_has_marker(document) for document in tree.facts):
        return parse_rosparam_yaml(data)
    diagnostics = list(tree.diagnostics)
    sets: list[ParameterSet] = []
    for document in _maps(tree.facts, diagnostics):
        _read_nodes(document, "", sets, diagnostics)
    return Parsed(ParameterFile(2, tuple(sets)), tuple(diagnostics))


def parse_rosparam_yaml(data: bytes) -> Parsed[ParameterFile]:
    """Read a file as `rosparam load` of ROS 1 does: every key is part of a name, those of ROS 2 as well."""
    tree = parse_yaml(data, typed_by_rosparam)
    diagnostics = list(tree.diagnostics)
    sets: list[ParameterSet] = []
    for document in _maps(tree.facts, diagnostics):
        _read_values(document, _Scope(None, "/", ""), sets)
    return Parsed(ParameterFile(1, tuple(sets)), tuple(diagnostics))


def _maps(documents: Iterable[Node], diagnostics: list[Diagnostic]) -> Iterator[Mapping]:
    """Yield the documents that can set parameters."""
    for document in documents:
        if isinstance(document, Mapping):
            yield document
        elif not any(entry.code == "params-not-a-map" for entry in diagnostics):
            message = "A document that is not a map sets no parameters and is skipped."
            diagnostics.append(Diagnostic("info", "params-not-a-map", document.line, message))


def parameter_type(value: Any) -> str:
    """Return the name of a value's parameter type; `array` when its items differ or it is empty."""
    if isinstance(value, dict):
        return "map"
    if not isinstance(value, list):
        return _TYPES.get(type(value), "string")
    kinds = {parameter_type(item) for item in value}
    if len(kinds) == 1 and kinds <= {"bool", "int", "double", "string"}:
        return f"{kinds.pop()}_array"
    return "array"


class _Scope(msgspec.Struct, frozen=True):
    """Where nested names hang: node, separator and the name so far."""

    node: str | None
    separator: str
    prefix: str

    def name(self, key: str) -> str:
        """Return the full name of `key` in this scope."""
        is_absolute = self.node is None and key.startswith(self.separator)  # rosgraph `names.ns_join`
        if not self.prefix or is_absolute:
            return key[:MAX_NAME]
        return f"{self.prefix.rstrip(self.separator)}{self.separator}{key.lstrip(self.separator)}"[:MAX_NAME]


def _has_marker(node: Node, depth: int = 0) -> bool:
    """Tell whether `ros__parameters` stands somewhere on the way down through maps."""
    if not isinstance(node, Mapping) or depth > MAX_NAMESPACES:
        return False
    return any(entry.key == MARKER or _has_marker(entry.value, depth + 1) for entry in node.entries)


def _read_nodes(namespace: Mapping, path: str, sets: list[ParameterSet], diagnostics: list[Diagnostic]) -> None:
    """Walk namespaces and nodes down to their parameters."""
    for entry in namespace.entries:
        if entry.key == MARKER:
            scope = _Scope(path or "/**", ".", "")
            if isinstance(entry.value, Mapping):
                _read_values(entry.value, scope, sets)
        elif _has_marker(entry.value) and isinstance(entry.value, Mapping):
            _read_nodes(entry.value, f"{path}/{entry.key.strip('/')}", sets, diagnostics)
        elif not _is_empty_node(entry):
            message = f"'{entry.key[:80]}' is outside any '{MARKER}' and sets nothing in ROS 2. Nest it below one."
            diagnostics.append(Diagnostic("info", "params-outside-node", entry.line, message))


def _is_empty_node(entry: Entry) -> bool:
    return isinstance(entry.value, Scalar) and entry.value.value is None


def _read_values(values: Mapping, scope: _Scope, sets: list[ParameterSet]) -> None:
    """Collect leaves; an empty map is a leaf. Of duplicate keys ROS 1 takes the last, ROS 2 reads each."""
    for entry in values.unique() if scope.node is None else values.entries:
        name = scope.name(entry.key)
        if isinstance(entry.value, Mapping) and entry.value.entries:
            _read_values(entry.value, _Scope(scope.node, scope.separator, name), sets)
        else:
            value = plain(entry.value) if scope.node is not None else _of_rosparam(entry.value)
            sets.append(ParameterSet(scope.node, name, value, parameter_type(value), entry.line, entry.column))


def _of_rosparam(node: Node) -> Any:
    """Plain data as rosparam reads it: angles are numbers."""
    if isinstance(node, Sequence):
        return [_of_rosparam(item) for item in node.items]
    if isinstance(node, Mapping):
        return {entry.key: _of_rosparam(entry.value) for entry in node.entries}
    return of_rosparam(node)
