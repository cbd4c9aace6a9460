"""What the classes and functions of `launch`, `launch_ros`, `ament_index_python` and `os.path` make.

Sources: the API pages of `launch` and `launch_ros`; `nav2_common.launch` for its widely used substitutions. A new
action or substitution is a row of `CONSTRUCTORS`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
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
    Substitution,
    Template,
)
from ecm_parsers.launch.values import (
    Condition,
    Description,
    Text,
    Unknown,
    Value,
    actions_of,
    data_of,
    merged_text,
    parameter_sources,
    template_of,
    text_of,
)


class Arguments(msgspec.Struct, frozen=True):
    """What a call is given; `line` is 1-based."""

    positional: tuple[Value, ...]
    keywords: Mapping[str, Value]
    line: int

    def get(self, name: str, position: int | None = None, default: Value = None) -> Value:
        """Return a keyword argument, or the positional one that stands for it."""
        if name in self.keywords:
            return self.keywords[name]
        if position is not None and position < len(self.positional):
            return self.positional[position]
        return default

    def template(self, name: str, position: int | None = None) -> Template:
        """Return an argument as text with substitutions."""
        return template_of(self.get(name, position))

    def optional(self, name: str, position: int | None = None) -> Template | None:
        """Return an argument as text, None when it is not given or None."""
        value = self.get(name, position)
        return None if value is None else template_of(value)

    @property
    def condition(self) -> Template | None:
        """What `condition=` asks for."""
        value = self.get("condition")
        return value.holds if isinstance(value, Condition) else None if value is None else template_of(value)


Constructor = Callable[[Arguments], Value]


def _sub(kind: str, *args: Template) -> Text:
    return Text((Substitution(kind, args),))


# --- substitutions -------------------------------------------------------------------------------------------


def _one(kind: str, name: str) -> Constructor:
    return lambda given: _sub(kind, given.template(name, 0))


def _with_default(kind: str, name: str, default: str) -> Constructor:
    def make(given: Arguments) -> Value:
        otherwise = given.optional(default, 1)
        return _sub(kind, given.template(name, 0), *(() if otherwise is None else (otherwise,)))

    return make


def _operands(kind: str) -> Constructor:
    def make(given: Arguments) -> Value:
        values = [*given.positional, *given.keywords.values()]
        return _sub(kind, *(template_of(value) for value in values))

    return make


def _not_equals(given: Arguments) -> Value:
    return _sub("not", _sub("equals", *(template_of(value) for value in given.positional)).parts)


def _path_join(given: Arguments) -> Value:
    listed = given.get("substitutions", 0, ())
    items = listed if isinstance(listed, list | tuple) else [listed]
    return joined_path(tuple(items))


def _os_path_join(given: Arguments) -> Value:
    return joined_path(given.positional)


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


def _parent(given: Arguments) -> Value:
    parts = template_of(given.get("path", 0))
    if parts and isinstance(parts[-1], str) and "/" in parts[-1]:
        return merged_text((*parts[:-1], parts[-1].rsplit("/", 1)[0]))
    return merged_text((*parts, "/.."))


def _basename(given: Arguments) -> Value:
    text = text_of(given.get("path", 0))
    return text.rsplit("/", 1)[-1] if text is not None else Unknown("basename")


def _same(given: Arguments) -> Value:
    return given.get("", 0)


def _text(given: Arguments) -> Value:
    return merged_text(given.template("text", 0))


def _string_join(given: Arguments) -> Value:
    items = given.get("substitutions", 0, ())
    between = given.template("delimiter", 1)
    parts: Template = ()
    for at, item in enumerate(items if isinstance(items, list | tuple) else [items]):
        parts = (*parts, *(between if at else ()), *template_of(item))
    return merged_text(parts)


def _has_parameters(given: Arguments) -> Value:
    return _sub("has_parameters", given.template("source_file", 0), given.template("node_name", 1))


def _xacro(given: Arguments) -> Value:
    """`xacro.process_file(path, mappings={...})` is the command line that does the same."""
    mappings = given.get("mappings", default={})
    words: Template = ("xacro ", *given.template("input_file_name", 0))
    for name, value in mappings.items() if isinstance(mappings, dict) else ():
        words = (*words, f" {name}:=", *template_of(value))
    return _sub("command", words)


def _python_expression(given: Arguments) -> Value:
    return _sub("eval", given.template("expression", 0))


# --- conditions ----------------------------------------------------------------------------------------------


def _if(given: Arguments) -> Value:
    return Condition(given.template("predicate_expression", 0))


def _unless(given: Arguments) -> Value:
    return Condition((Substitution("not", (given.template("predicate_expression", 0),)),))


def _configuration_equals(given: Arguments) -> Value:
    configuration = (Substitution("arg", (given.template("launch_configuration_name", 0),)),)
    return Condition((Substitution("equals", (configuration, given.template("expected_value", 1))),))


def _configuration_differs(given: Arguments) -> Value:
    return Condition((Substitution("not", (_configuration_equals(given).holds,)),))


# --- actions -------------------------------------------------------------------------------------------------


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
            arguments=_command(given.get("arguments", default=())) + _command(given.get("ros_arguments", default=())),
            components=_components(components),
            respawn=given.optional("respawn"),
        )

    return make


def _spawner(given: Arguments) -> Value:
    """The helpers of `controller_manager.launch_utils`, which start one spawner for the controllers they are given."""
    names = given.get("controller_names", 0) or given.get("controller_name", 0) or given.get("controller_info_dict", 0)
    listed = list(names) if isinstance(names, list | tuple | dict) else [names]
    files = given.get("controller_params_files") or given.get("controller_params_file", 1) or []
    if isinstance(names, dict):
        files = [file for value in names.values() for file in (value if isinstance(value, list) else [value])]
    options = [word for file in (files if isinstance(files, list) else [files]) for word in ("--param-file", file)]
    extra = given.get("extra_spawner_args", default=[])
    words = [*listed, *options, *(extra if isinstance(extra, list) else [])]
    spawner = Node(
        line=given.line,
        kind="node",
        package=("controller_manager",),
        executable=("spawner",),
        arguments=_command([word for word in words if word is not None]),
    )
    return Description([spawner])


def _components(value: Value) -> tuple[Node, ...]:
    return tuple(action for action in actions_of(value) if isinstance(action, Node))


def _command(value: Value) -> tuple[Template, ...]:
    if not isinstance(value, list | tuple):
        return (template_of(value),) if value is not None else ()
    return tuple(template_of(item) for item in value)


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
    return Node(line=given.line, condition=given.condition, kind="process", arguments=_command(flat))


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


def _holding(*names: str) -> Constructor:
    """An action or event handler that takes other actions later; with no scope of its own."""

    def make(given: Arguments) -> Value:
        found: list[Action] = []
        for at, name in enumerate(names):
            found += actions_of(given.get(name, at if len(names) == 1 else None))
        return Group(line=given.line, condition=given.condition, actions=tuple(found), scoped=False)

    return make


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
    return inner if isinstance(inner, ParameterFile) else ParameterFile(line=given.line, path=template_of(inner))


def _rewritten(given: Arguments) -> Value:
    source = given.get("source_file", 0)
    rewrites = given.get("param_rewrites", 1, {})
    known = rewrites if isinstance(rewrites, dict) else {}
    return ParameterFile(
        line=given.line,
        path=source.path if isinstance(source, ParameterFile) else template_of(source),
        namespace=given.template("root_key", 2),
        rewrites=tuple((template_of(key), template_of(value)) for key, value in known.items()),
    )


def _parameter_value(given: Arguments) -> Value:
    return ParameterValue(line=given.line, name=(), value=data_of(given.get("value", 0)))


def _source(given: Arguments) -> Value:
    return merged_text(given.template("launch_file_path", 0))


CONSTRUCTORS: Mapping[str, Constructor] = MappingProxyType(
    {
        "LaunchConfiguration": _with_default("arg", "variable_name", "default"),
        "LaunchConfigAsBool": _one("arg", "name"),
        "EnvironmentVariable": _with_default("env", "name", "default_value"),
        "OptionalEnvironmentVariable": _with_default("env", "name", "default_value"),
        "getenv": _with_default("env", "key", "default"),
        "FindPackageShare": _one("find", "package"),
        "FindPackage": _one("find", "package"),
        "FindPackagePrefix": _one("find_prefix", "package"),
        "get_package_share_directory": _one("find", "package_name"),
        "get_package_share_path": _one("find", "package_name"),
        "get_package_prefix": _one("find_prefix", "package_name"),
        "FindExecutable": _one("command", "name"),
        "ExecutableInPackage": _one("command", "executable"),
        "Command": _one("command", "command"),
        "PythonExpression": _python_expression,
        "TextSubstitution": _text,
        "ThisLaunchFileDir": lambda _: _sub("dirname"),
        "ThisLaunchFile": lambda _: _sub("unknown", ("this launch file",)),
        "AnonName": _one("anon", "name"),
        "PathJoinSubstitution": _path_join,
        "PathSubstitution": _same,
        "StringJoinSubstitution": _string_join,
        "NotSubstitution": _operands("not"),
        "AndSubstitution": _operands("and"),
        "OrSubstitution": _operands("or"),
        "EqualsSubstitution": _operands("equals"),
        "NotEqualsSubstitution": _not_equals,
        "IfElseSubstitution": _operands("if"),
        "HasNodeParams": _has_parameters,
        "ReplaceString": lambda given: merged_text(given.template("source_file", 0)),
        "IfCondition": _if,
        "UnlessCondition": _unless,
        "LaunchConfigurationEquals": _configuration_equals,
        "LaunchConfigurationNotEquals": _configuration_differs,
        "LaunchDescription": _description,
        "DeclareLaunchArgument": _argument,
        "Node": _node("node"),
        "LifecycleNode": _node("lifecycle_node"),
        "generate_controllers_spawner_launch_description": _spawner,
        "generate_controllers_spawner_launch_description_from_dict": _spawner,
        "generate_load_controller_launch_description": _spawner,
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
        "TimerAction": _holding("actions"),
        "RegisterEventHandler": _holding("event_handler"),
        "OnProcessStart": _holding("on_start", ""),
        "OnProcessExit": _holding("on_exit", ""),
        "OnExecutionComplete": _holding("on_completion", ""),
        "OnStateTransition": _holding("entities", ""),
        "OnProcessIO": _holding("on_stdout", "on_stderr"),
        "ParameterFile": _parameter_file,
        "ParameterValue": _parameter_value,
        "RewrittenYaml": _rewritten,
        "open": _one("file", "file"),
        "safe_load": _same,
        "full_load": _same,
        "process_file": _xacro,
        "process": _xacro,
        "Path": _os_path_join,
        "join": _os_path_join,
        "dirname": _parent,
        "basename": _basename,
        "abspath": _same,
        "realpath": _same,
        "normpath": _same,
        "expanduser": _same,
    }
)
