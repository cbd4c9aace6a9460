"""ROS 2 launch XML and YAML -> actions; both give the same entities.

Sources: docs.ros.org "Launch file different formats"; `launch.actions`, `launch_ros.actions` (`expose_action`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from types import MappingProxyType
from typing import Any

from ecm_parsers.launch.entity import Entity
from ecm_parsers.launch.markup import condition, incomplete, optional, template, words
from ecm_parsers.launch.model import (
    Action,
    Argument,
    Data,
    Group,
    Include,
    Node,
    NodeKind,
    ParameterFile,
    ParameterSource,
    ParameterValue,
    PushNamespace,
    Remap,
    SetConfiguration,
    Typing,
)
from ecm_parsers.launch.substitution import parse_template
from ecm_parsers.result import Diagnostic
from ecm_parsers.template import Substitution, Template

_QUIET = frozenset({"log", "log_info", "shutdown", "unset_env", "unset", "reset", "push_launch_configurations", "test"})
_TYPES: Mapping[str, Typing] = MappingProxyType({"str": "str", "int": "int", "float": "double", "bool": "bool"})
"""Typing by the attribute `type` of a parameter; lists are told by YAML."""
_CONTAINERS = frozenset({"timer", "forward", "launch", "on_exit"})
_PARTS = frozenset({"remap", "param", "env", "composable_node"})


class Ros2Reader:
    """Reads the elements of one file; what cannot be read is in `problems`."""

    def __init__(self) -> None:
        self.problems: list[Diagnostic] = []
        self._readers: dict[str, Callable[[Entity], Action | None]] = {
            "arg": self._argument,
            "let": self._let,
            "set_env": self._set_environment,
            "append_env": self._set_environment,
            "group": self._group,
            "include": self._include,
            "node": lambda entity: self._node(entity, "node"),
            "lifecycle_node": lambda entity: self._node(entity, "lifecycle_node"),
            "node_container": lambda entity: self._node(entity, "container"),
            "executable": self._process,
            "load_composable_node": self._load,
            "push_ros_namespace": _push,
            "push_namespace": _push,
            "set_remap": self._remap,
            "set_parameter": self._set_parameter,
            "set_parameters_from_file": _parameters_from_file,
        }

    @property
    def tags(self) -> frozenset[str]:
        """Elements whose attributes launch reads, those inside other elements too."""
        return frozenset(self._readers) | _CONTAINERS | _PARTS

    def actions(self, parent: Entity) -> tuple[Action, ...]:
        """Return the actions below an element, in order."""
        return tuple(self._read(parent))

    def _read(self, parent: Entity) -> Iterator[Action]:
        for entity in parent.children:
            reader = self._readers.get(entity.tag)
            if reader is not None:
                action = reader(entity)
                if action is not None:
                    yield action
            elif entity.tag in _CONTAINERS:
                inner = self.actions(entity)
                later = entity.tag in {"timer", "on_exit"}
                yield Group(line=entity.line, condition=condition(entity), actions=inner, scoped=False, later=later)
            elif entity.tag not in _QUIET:
                message = f"<{entity.tag}> is no known launch action and is skipped. Correct its name."
                self.problems.append(Diagnostic("info", "launch-unknown-element", entity.line, message))

    def _needs(self, entity: Entity, *names: str) -> bool:
        missing = next((name for name in names if not entity.get(name)), None)
        if missing is not None:
            self.problems.append(incomplete(entity, missing))
        return missing is None

    def _argument(self, entity: Entity) -> Argument | None:
        if not self._needs(entity, "name"):
            return None
        return Argument(
            line=entity.line,
            condition=condition(entity),
            name=entity.attributes["name"],
            default=optional(entity, "default"),
            description=entity.get("description") or "",
            choices=tuple(child.get("value") or "" for child in entity.below("choice")),
        )

    def _let(self, entity: Entity) -> SetConfiguration | None:
        if not self._needs(entity, "name"):
            return None
        name, value = template(entity, "name"), template(entity, "value")
        return SetConfiguration(line=entity.line, condition=condition(entity), name=name, value=value)

    def _set_environment(self, entity: Entity) -> SetConfiguration:
        name, value = template(entity, "name"), template(entity, "value")
        return SetConfiguration(line=entity.line, condition=condition(entity), name=name, value=value, environment=True)

    def _group(self, entity: Entity) -> Group:
        scoped = (entity.get("scoped") or "true").lower() != "false"
        inner = self.actions(entity)
        return Group(line=entity.line, condition=condition(entity), actions=inner, scoped=scoped)

    def _include(self, entity: Entity) -> Include | None:
        if not self._needs(entity, "file"):
            return None
        given = [child for child in entity.below("arg", "let") if child.get("name")]
        return Include(
            line=entity.line,
            condition=condition(entity),
            path=template(entity, "file"),
            arguments=tuple((child.attributes["name"], template(child, "value")) for child in given),
            argument_lines=tuple(child.line for child in given),
            pass_all=True,
        )

    def _node(self, entity: Entity, kind: NodeKind) -> Node | None:
        if not self._needs(entity, "pkg", "exec"):
            return None
        return Node(
            line=entity.line,
            condition=condition(entity),
            kind=kind,
            package=template(entity, "pkg"),
            executable=template(entity, "exec"),
            name=optional(entity, "name"),
            namespace=optional(entity, "namespace"),
            remaps=self._remaps(entity),
            parameters=tuple(self._parameters(entity)),
            arguments=(*words(entity.get("args")), *_ros_words(entity.get("ros_args"))),
            components=tuple(self._component(child) for child in entity.below("composable_node")),
            respawn=optional(entity, "respawn"),
        )

    def _component(self, entity: Entity, target: Template | None = None) -> Node:
        return Node(
            line=entity.line,
            condition=condition(entity),
            kind="component",
            package=template(entity, "pkg"),
            plugin=template(entity, "plugin"),
            name=optional(entity, "name"),
            namespace=optional(entity, "namespace"),
            remaps=self._remaps(entity),
            parameters=tuple(self._parameters(entity)),
            target=target,
        )

    def _load(self, entity: Entity) -> Group:
        target = template(entity, "target")
        nodes = tuple(self._component(child, target) for child in entity.below("composable_node"))
        return Group(line=entity.line, condition=condition(entity), actions=nodes, scoped=False)

    def _process(self, entity: Entity) -> Node:
        command = words(entity.get("cmd"))
        return Node(line=entity.line, condition=condition(entity), kind="process", arguments=command)

    def _remap(self, entity: Entity) -> Remap | None:
        if not self._needs(entity, "from", "to"):
            return None
        source, target = template(entity, "from"), template(entity, "to")
        return Remap(line=entity.line, condition=condition(entity), source=source, target=target)

    def _remaps(self, entity: Entity) -> tuple[Remap, ...]:
        found = [self._remap(child) for child in entity.below("remap")]
        return tuple(entry for entry in found if entry is not None)

    def _parameters(self, entity: Entity) -> Iterator[ParameterSource]:
        for child in entity.below("param"):
            yield from self._parameter(child, "")

    def _parameter(self, entity: Entity, prefix: str) -> Iterator[ParameterSource]:
        if entity.get("from"):
            path = template(entity, "from")
            allowed = (entity.get("allow_substs") or "false").lower() not in {"false", "0"}
            yield ParameterFile(line=entity.line, condition=condition(entity), path=path, substitutes=allowed)
            return
        if not self._needs(entity, "name"):
            return
        name = parse_template(prefix + entity.attributes["name"])
        nested = list(entity.below("param"))
        if entity.get("value") is not None or not nested:
            yield _given(entity, name)
        for child in nested:
            yield from self._parameter(child, f"{prefix}{entity.attributes['name']}.")

    def _set_parameter(self, entity: Entity) -> ParameterValue | None:
        if not self._needs(entity, "name"):
            return None
        return ParameterValue(
            line=entity.line,
            condition=condition(entity),
            name=template(entity, "name"),
            value=template(entity, "value"),
        )


def _ros_words(text: str | None) -> tuple[Template, ...]:
    """Words that stand after `--ros-args`, which launch writes before them."""
    found = words(text)
    return (("--ros-args",), *found) if found else ()


def _push(entity: Entity) -> PushNamespace:
    namespace = template(entity, "namespace") or parse_template(entity.text.strip())
    return PushNamespace(line=entity.line, condition=condition(entity), namespace=namespace)


def _parameters_from_file(entity: Entity) -> ParameterFile:
    path = template(entity, "filename")
    return ParameterFile(line=entity.line, condition=condition(entity), path=path)


def _given(entity: Entity, name: Template) -> ParameterValue:
    """A parameter of a node; in YAML a text that is written as text stays one, in XML every text is read as YAML."""
    asked = _TYPES.get(entity.get("type") or "")
    value = _written(entity.data["value"]) if "value" in entity.data else _value(entity)
    kept = "value" in entity.data and not _substitutes(value)
    typing: Typing = asked or ("str" if kept else "yaml")
    return ParameterValue(line=entity.line, condition=condition(entity), name=name, value=value, typing=typing)


def _written(value: Any) -> Data:
    """Return a value of YAML with its substitutions."""
    if isinstance(value, list):
        return [_written(item) for item in value]
    return parse_template(value) if isinstance(value, str) else value


def _substitutes(value: Data) -> bool:
    items = value if isinstance(value, list | tuple) else ()
    return any(
        isinstance(item, Substitution) or _substitutes(item if isinstance(item, list | tuple) else None)
        for item in items
    )


def _value(entity: Entity) -> Data:
    """Return a value; with `value-sep` it is a list."""
    separator = entity.get("value-sep", "value_sep")
    text = entity.get("value")
    if text is not None and separator:
        return [parse_template(item) for item in text.split(separator)]
    return parse_template(text)
