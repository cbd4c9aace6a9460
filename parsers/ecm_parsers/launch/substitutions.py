"""Substitutions and conditions of `launch` in Python.

Sources: the API pages of `launch` and `launch_ros`; `nav2_common.launch` for its widely used substitutions. A new
substitution is a row of `SUBSTITUTIONS`.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ecm_parsers.python.arguments import Arguments, Constructor
from ecm_parsers.python.library import joined_path, of_one, substituted, with_default
from ecm_parsers.python.values import Condition, Text, Value, merged_text, template_of
from ecm_parsers.template import Substitution, Template


def _operands(kind: str) -> Constructor:
    def make(given: Arguments) -> Value:
        values = [*given.positional, *given.keywords.values()]
        return substituted(kind, *(template_of(value) for value in values))

    return make


def _not_equals(given: Arguments) -> Value:
    return substituted("not", substituted("equals", *(template_of(value) for value in given.positional)).parts)


def _path_join(given: Arguments) -> Value:
    listed = given.get("substitutions", 0, ())
    items = listed if isinstance(listed, list | tuple) else [listed]
    return joined_path(tuple(items))


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
    return substituted("has_parameters", given.template("source_file", 0), given.template("node_name", 1))


def _xacro(given: Arguments) -> Value:
    """`xacro.process_file(path, mappings={...})` is the command line that does the same."""
    mappings = given.get("mappings", default={})
    words: Template = ("xacro ", *given.template("input_file_name", 0))
    for name, value in mappings.items() if isinstance(mappings, dict) else ():
        words = (*words, f" {name}:=", *template_of(value))
    return substituted("command", words)


def _python_expression(given: Arguments) -> Value:
    return substituted("eval", given.template("expression", 0))


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
        "LaunchConfiguration": with_default("arg", "variable_name", "default"),
        "LaunchConfigAsBool": of_one("arg", "name"),
        "EnvironmentVariable": with_default("env", "name", "default_value"),
        "OptionalEnvironmentVariable": with_default("env", "name", "default_value"),
        "FindPackageShare": of_one("find", "package"),
        "FindPackage": of_one("find", "package"),
        "FindPackagePrefix": of_one("find_prefix", "package"),
        "get_package_share_directory": of_one("find", "package_name"),
        "get_package_share_path": of_one("find", "package_name"),
        "get_package_prefix": of_one("find_prefix", "package_name"),
        "FindExecutable": of_one("command", "name"),
        "ExecutableInPackage": of_one("command", "executable"),
        "Command": of_one("command", "command"),
        "PythonExpression": _python_expression,
        "TextSubstitution": _text,
        "ThisLaunchFileDir": lambda _: substituted("dirname"),
        "ThisLaunchFile": lambda _: substituted("unknown", ("this launch file",)),
        "AnonName": of_one("anon", "name"),
        "PathJoinSubstitution": _path_join,
        "PathSubstitution": lambda given: given.get("", 0),
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
        "process_file": _xacro,
        "process": _xacro,
    }
)
