"""Actions and event handlers of `launch` and `launch_ros` in Python.

Sources: the API pages of `launch`, `launch_ros` and `controller_manager`. A new action is a row of `ACTIONS`.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import msgspec

from ecm_parsers.launch.model import (
    Action,
    Argument,
    Group,
    Include,
    Node,
    NodeKind,
    ParameterFile,
    ParameterValue,
    PushNamespace,
    Remap,
    SetConfiguration,
    Typing,
)
from ecm_parsers.launch.spawners import controller_spawner
from ecm_parsers.launch.values import Description, actions_of, command_words, data_of, parameter_sources, typing_of
from ecm_parsers.python.arguments import Arguments, Constructor
from ecm_parsers.python.values import Reference, Unknown, Value, merged_text, template_of, text_of
from ecm_parsers.template import Template


def _description(given: Arguments) -> Value:
    value = given.get("initial_entities", 0, ())
    return Description(list(value) if isinstance(value, list | tuple) else [value])


def _argument(given: Arguments) -> Value:
    name = text_of(given.get("name", 0))
    if not name:
        return Unknown("DeclareLaunchArgument")
    choices = given.get("choices", default=())
    return Argument(
        line=given.line,
        condition=given.condition,
        name=name,
        default=given.optional("default_value", 1),
        description=text_of(given.get("description", default="")) or "",
        choices=tuple(text_of(choice) or "" for choice in choices if isinstance(choice, str))
        if isinstance(choices, list | tuple)
        else (),
    )


def _node(kind: NodeKind) -> Constructor:
    def make(given: Arguments) -> Value:
        components = given.get("composable_node_descriptions", default=())
        return Node(
            line=given.line,
            condition=given.condition,
            kind=kind,
            package=given.template("package"),
            executable=given.template("executable") or given.template("node_executable"),
            plugin=given.template("plugin"),
            name=given.optional("name") or given.optional("node_name"),
            namespace=given.optional("namespace") or given.optional("node_namespace"),
            remaps=remaps_of(given.get("remappings"), given.line),
            parameters=parameter_sources(given.get("parameters", default=()), given.line),
            arguments=command_words(given.get("arguments", default=())) + _ros_words(given.get("ros_arguments")),
            components=_components(components),
            respawn=given.optional("respawn"),
        )

    return make


def _ros_words(value: Value) -> tuple[Template, ...]:
    """Words that stand after `--ros-args`, which launch writes before them."""
    found = command_words(value if value is not None else ())
    return (("--ros-args",), *found) if found else ()


def _components(value: Value) -> tuple[Node, ...]:
    return tuple(action for action in actions_of(value) if isinstance(action, Node))


def remaps_of(value: Value, line: int) -> tuple[Remap, ...]:
    """Return `remappings=[(from, to), ...]`."""
    pairs = value if isinstance(value, list | tuple) else []
    return tuple(
        Remap(line=line, source=template_of(pair[0]), target=template_of(pair[1]))
        for pair in pairs
        if isinstance(pair, list | tuple) and len(pair) == 2
    )


def _process(given: Arguments) -> Value:
    command = given.get("cmd", default=())
    flat = (
        [part for word in command for part in (word if isinstance(word, list | tuple) else [word])]
        if isinstance(command, list | tuple)
        else [command]
    )
    return Node(line=given.line, condition=given.condition, kind="process", arguments=command_words(flat))


def _load(given: Arguments) -> Value:
    target = given.get("target_container", 1)
    name = target.name if isinstance(target, Node) else template_of(target)
    nodes = _components(given.get("composable_node_descriptions", 0))
    loaded = tuple(msgspec.structs.replace(node, target=name) for node in nodes)
    return Group(line=given.line, condition=given.condition, actions=loaded, scoped=False)


def _include(given: Arguments) -> Value:
    listed = given.get("launch_arguments", 1, default=())
    items = list(listed.items()) if isinstance(listed, dict) else listed if isinstance(listed, list | tuple) else ()
    pairs = [pair for pair in items if isinstance(pair, list | tuple) and len(pair) == 2]
    return Include(
        line=given.line,
        condition=given.condition,
        path=given.template("launch_description_source", 0),
        arguments=tuple((text_of(name) or "", template_of(value)) for name, value in pairs if text_of(name)),
        pass_all=True,
    )


def _group(given: Arguments) -> Value:
    actions = actions_of(given.get("actions", 0, ()))
    scoped = given.get("scoped", default=True) is not False
    return Group(line=given.line, condition=given.condition, actions=actions, scoped=scoped)


def _holding(*names: str, later: bool = False) -> Constructor:
    """An action or event handler that takes other actions later; with no scope of its own."""

    def make(given: Arguments) -> Value:
        found: list[Action] = []
        for at, name in enumerate(names):
            found += actions_of(given.get(name, at if len(names) == 1 else None))
        return Group(line=given.line, condition=given.condition, actions=tuple(found), scoped=False, later=later)

    return make


def _nothing(_: Arguments) -> Value:
    """An action that starts and changes nothing of what is read here."""
    return None


def _push(given: Arguments) -> Value:
    return PushNamespace(line=given.line, condition=given.condition, namespace=given.template("namespace", 0))


def _remap(given: Arguments) -> Value:
    return Remap(
        line=given.line,
        condition=given.condition,
        source=given.template("src", 0),
        target=given.template("dst", 1),
    )


def _parameter(given: Arguments) -> Value:
    return ParameterValue(
        line=given.line,
        condition=given.condition,
        name=given.template("name", 0),
        value=data_of(given.get("value", 1)),
        typing=typing_of(given.get("value", 1)),
    )


def _parameters_from_file(given: Arguments) -> Value:
    return ParameterFile(line=given.line, condition=given.condition, path=given.template("filename", 0))


def _setting(environment: bool) -> Constructor:
    def make(given: Arguments) -> Value:
        return SetConfiguration(
            line=given.line,
            condition=given.condition,
            name=given.template("name", 0),
            value=given.template("value", 1),
            environment=environment,
        )

    return make


def _parameter_file(given: Arguments) -> Value:
    inner = given.get("param_file", 0)
    made = inner if isinstance(inner, ParameterFile) else ParameterFile(line=given.line, path=template_of(inner))
    allowed = given.get("allow_substs", default=False)
    return msgspec.structs.replace(made, substitutes=allowed is not False)


def _rewritten(given: Arguments) -> Value:
    source = given.get("source_file", 0)
    rewrites = given.get("param_rewrites", 1, {})
    known = rewrites if isinstance(rewrites, dict) else {}
    return ParameterFile(
        line=given.line,
        path=source.path if isinstance(source, ParameterFile) else template_of(source),
        namespace=given.template("root_key", 2),
        rewrites=tuple((template_of(key), template_of(value)) for key, value in known.items()),
        converts=given.get("convert_types", 4) is True,
    )


def _parameter_value(given: Arguments) -> Value:
    value = given.get("value", 0)
    asked = given.get("value_type")
    name = asked.path if isinstance(asked, Reference) else ""
    return ParameterValue(line=given.line, name=(), value=data_of(value), typing=_TYPES.get(name) or typing_of(value))


_TYPES: Mapping[str, Typing] = MappingProxyType({"str": "str", "int": "int", "float": "double", "bool": "bool"})
"""Typing by the `value_type` of a parameter; lists are told by YAML."""


def _source(given: Arguments) -> Value:
    return merged_text(given.template("launch_file_path", 0))


ACTIONS: Mapping[str, Constructor] = MappingProxyType(
    {
        "LaunchDescription": _description,
        "DeclareLaunchArgument": _argument,
        "Node": _node("node"),
        "LifecycleNode": _node("lifecycle_node"),
        "generate_controllers_spawner_launch_description": controller_spawner,
        "generate_controllers_spawner_launch_description_from_dict": controller_spawner,
        "generate_load_controller_launch_description": controller_spawner,
        "ComposableNodeContainer": _node("container"),
        "ComposableNode": _node("component"),
        "ComposableLifecycleNode": _node("component"),
        "LoadComposableNodes": _load,
        "ExecuteProcess": _process,
        "ExecuteLocal": _process,
        "IncludeLaunchDescription": _include,
        "PythonLaunchDescriptionSource": _source,
        "AnyLaunchDescriptionSource": _source,
        "XMLLaunchDescriptionSource": _source,
        "YAMLLaunchDescriptionSource": _source,
        "FrontendLaunchDescriptionSource": _source,
        "GroupAction": _group,
        "PushRosNamespace": _push,
        "PushROSNamespace": _push,
        "PushNamespace": _push,
        "SetRemap": _remap,
        "SetParameter": _parameter,
        "SetParametersFromFile": _parameters_from_file,
        "SetUseSimTime": lambda given: ParameterValue(
            line=given.line, condition=given.condition, name=("use_sim_time",), value=data_of(given.get("value", 0))
        ),
        "SetLaunchConfiguration": _setting(environment=False),
        "SetEnvironmentVariable": _setting(environment=True),
        "AppendEnvironmentVariable": _setting(environment=True),
        "TimerAction": _holding("actions", later=True),
        "RosTimer": _holding("actions", later=True),
        "ROSTimer": _holding("actions", later=True),
        "LogInfo": _nothing,
        "EmitEvent": _nothing,
        "Shutdown": _nothing,
        "UnregisterEventHandler": _nothing,
        "UnsetEnvironmentVariable": _nothing,
        "UnsetLaunchConfiguration": _nothing,
        "ResetLaunchConfigurations": _nothing,
        "PushEnvironment": _nothing,
        "PopEnvironment": _nothing,
        "ResetEnvironment": _nothing,
        "PushLaunchConfigurations": _nothing,
        "PopLaunchConfigurations": _nothing,
        "LifecycleTransition": _nothing,
        "ReadyToTest": _nothing,
        "KeepAliveProc": _nothing,
        "RegisterEventHandler": _holding("event_handler", later=True),
        "OnProcessStart": _holding("on_start", ""),
        "OnProcessExit": _holding("on_exit", ""),
        "OnExecutionComplete": _holding("on_completion", ""),
        "OnStateTransition": _holding("entities", ""),
        "OnShutdown": _holding("on_shutdown", ""),
        "OnProcessIO": _holding("on_stdout", "on_stderr"),
        "ParameterFile": _parameter_file,
        "ParameterValue": _parameter_value,
        "RewrittenYaml": _rewritten,
    }
)
