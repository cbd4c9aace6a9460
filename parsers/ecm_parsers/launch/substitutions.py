"""Substitutions and conditions of `launch` in Python, and the path functions that launch files use beside them.

Sources: the API pages of `launch` and `launch_ros`; `nav2_common.launch` for its widely used substitutions. A new
substitution is a row of `SUBSTITUTIONS`.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ecm_parsers.launch.arguments import Arguments, Constructor
from ecm_parsers.launch.model import Substitution, Template
from ecm_parsers.launch.values import Condition, Text, Unknown, Value, merged_text, template_of


def _sub(kind: str, *args: Template) -> Text:
    return Text((Substitution(kind, args),))


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
    parts = given.template("path", 0)
    if parts and isinstance(parts[-1], str) and ("/" in parts[-1] or len(parts) == 1):
        return parts[-1].rsplit("/", 1)[-1]
    return Unknown("basename")


def _yaml(given: Arguments) -> Value:
    """What a YAML file holds is named by its path, which is what readers of parameters look for."""
    value = given.get("stream", 0)
    parts = value.parts if isinstance(value, Text) else ()
    if len(parts) == 1 and isinstance(parts[0], Substitution) and parts[0].kind == "file":
        return _sub("yaml", *parts[0].args)
    return Text(value.parts, value.is_str) if isinstance(value, Text) else value


def _same(given: Arguments) -> Value:
    return given.get("", 0)


def _text(given: Arguments) -> Value:
    """A substitution all the same, whose text is read as YAML where it is the value of a parameter."""
    return Text(given.template("text", 0))


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


def _if(given: Arguments) -> Value:
    return Condition(given.template("predicate_expression", 0))


def _unless(given: Arguments) -> Value:
    return Condition((Substitution("not", (given.template("predicate_expression", 0),)),))


def _configuration_equals(given: Arguments) -> Value:
    configuration = (Substitution("arg", (given.template("launch_configuration_name", 0),)),)
    return Condition((Substitution("equals", (configuration, given.template("expected_value", 1))),))


def _configuration_differs(given: Arguments) -> Value:
    return Condition((Substitution("not", (_configuration_equals(given).holds,)),))


SUBSTITUTIONS: Mapping[str, Constructor] = MappingProxyType(
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
        "open": _one("file", "file"),
        "safe_load": _yaml,
        "full_load": _yaml,
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
