"""CMake variables: references in arguments, and the commands that set them.

What is not known stays a reference (`${catkin_LIBRARIES}`), what is globbed stays a pattern (`src/*.cpp`).
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Callable

from ecm_parsers.cmake_tokens import Argument

Variables = dict[str, str]

MAX_VARIABLES = 5_000
MAX_VALUE = 30_000
MAX_NESTING = 8
_REFERENCE = re.compile(r"\$\{([A-Za-z0-9_./+@-]*)\}")
_UNKNOWN = re.compile("\x01([^\x02]*)\x02")
_ESCAPE = re.compile(r"\\([^A-Za-z0-9;])")
_HERE = frozenset({"CMAKE_CURRENT_SOURCE_DIR", "CMAKE_CURRENT_LIST_DIR"})
_GLOB_OPTIONS = frozenset({"CONFIGURE_DEPENDS", "FOLLOW_SYMLINKS", "LIST_DIRECTORIES", "true", "false"})


def expand(argument: Argument, variables: Variables) -> list[str]:
    """Return the values that an argument stands for: several when it is unquoted and holds a list."""
    if argument.form == "bracket":
        return [argument.text]
    value = expand_text(argument.text, variables)
    if argument.form == "quoted":
        return [value]
    return [item for item in value.split(";") if item]


def expand_text(text: str, variables: Variables) -> str:
    """Replace references that are known, innermost first, and remove escapes."""

    def value_of(match: re.Match[str]) -> str:
        name = match[1]
        if name in variables:
            return variables[name]
        return "." if name in _HERE else f"\x01{name}\x02"

    for _ in range(MAX_NESTING):
        if "${" not in text or len(text) > MAX_VALUE:
            break
        text, count = _REFERENCE.subn(value_of, text)
        if not count:
            break
    text = _UNKNOWN.sub(r"${\1}", text)
    return _ESCAPE.sub(r"\1", text)[:MAX_VALUE]


def assign(name: str, values: list[str], variables: Variables) -> None:
    """Set a variable to a list, as long as there are not too many variables."""
    if name in variables or len(variables) < MAX_VARIABLES:
        variables[name] = ";".join(values)[:MAX_VALUE]


def run_set(args: list[str], variables: Variables) -> None:
    """`set(NAME values... [CACHE TYPE doc] [PARENT_SCOPE])`; without values the variable goes."""
    if not args:
        return
    values = args[1:]
    if "CACHE" in values:
        values = values[: values.index("CACHE")]
    values = [value for value in values if value != "PARENT_SCOPE"]
    if values:
        assign(args[0], values, variables)
    else:
        variables.pop(args[0], None)


def run_list(args: list[str], variables: Variables) -> None:
    """`list(APPEND|PREPEND|REMOVE_ITEM NAME values...)`; other forms leave the list as it is."""
    if len(args) < 2:
        return
    action, name, values = args[0], args[1], args[2:]
    items = [item for item in variables.get(name, "").split(";") if item]
    if action == "APPEND":
        assign(name, items + values, variables)
    elif action == "PREPEND":
        assign(name, values + items, variables)
    elif action == "REMOVE_ITEM":
        assign(name, [item for item in items if item not in set(values)], variables)
    elif action == "TRANSFORM" and len(values) > 1 and values[0] in {"PREPEND", "APPEND"}:
        prefix, suffix = (values[1], "") if values[0] == "PREPEND" else ("", values[1])
        assign(name, [f"{prefix}{item}{suffix}" for item in items], variables)


def run_file(args: list[str], variables: Variables) -> None:
    """`file(GLOB|GLOB_RECURSE NAME patterns...)`: the value is the patterns."""
    if len(args) < 3 or args[0] not in {"GLOB", "GLOB_RECURSE"}:
        return
    patterns = args[2:]
    if "RELATIVE" in patterns:
        at = patterns.index("RELATIVE")
        patterns = patterns[:at] + patterns[at + 2 :]
    patterns = [pattern for pattern in patterns if pattern not in _GLOB_OPTIONS]
    if args[0] == "GLOB_RECURSE":
        patterns = [posixpath.join(posixpath.dirname(p), "**", posixpath.basename(p)) for p in patterns]
    assign(args[1], patterns, variables)


def run_string(args: list[str], variables: Variables) -> None:
    """`string(TOLOWER|TOUPPER|CONCAT|APPEND|REPLACE ...)` over known text."""
    if len(args) < 3:
        return
    action = args[0]
    if action in {"TOLOWER", "TOUPPER"}:
        assign(args[2], [args[1].lower() if action == "TOLOWER" else args[1].upper()], variables)
    elif action == "CONCAT":
        assign(args[1], ["".join(args[2:])], variables)
    elif action == "APPEND":
        assign(args[1], [variables.get(args[1], "") + "".join(args[2:])], variables)
    elif action == "REPLACE" and len(args) > 4 and args[1]:
        assign(args[3], ["".join(args[4:]).replace(args[1], args[2])], variables)


def run_get_filename_component(args: list[str], variables: Variables) -> None:
    """`get_filename_component(NAME path DIRECTORY|NAME|NAME_WE|EXT ...)`."""
    if len(args) < 3:
        return
    name, path, part = args[:3]
    base = posixpath.basename(path)
    parts = {
        "DIRECTORY": posixpath.dirname(path),
        "PATH": posixpath.dirname(path),
        "NAME": base,
        "NAME_WE": base.split(".")[0],
        "NAME_WLE": posixpath.splitext(base)[0],
        "ABSOLUTE": path,
    }
    if part in parts:
        assign(name, [parts[part]], variables)


def run_aux_source_directory(args: list[str], variables: Variables) -> None:
    """`aux_source_directory(DIR NAME)`: all sources of a folder, as a pattern."""
    if len(args) == 2:
        assign(args[1], [posixpath.join(args[0], "*")], variables)


def run_parse_arguments(args: list[str], variables: Variables) -> None:
    """`cmake_parse_arguments(PREFIX options one multi args...)` sets `PREFIX_<keyword>`."""
    if len(args) < 4:
        return
    options, single, multi = (set(text.split(";")) - {""} for text in args[1:4])
    found: dict[str, list[str]] = {"UNPARSED_ARGUMENTS": []}
    current = "UNPARSED_ARGUMENTS"
    for value in args[4:]:
        if value in options or value in single or value in multi:
            found[value] = ["TRUE"] if value in options else []
            current = "UNPARSED_ARGUMENTS" if value in options else value
        else:
            found[current].append(value)
            current = "UNPARSED_ARGUMENTS" if current in single else current
    for keyword, values in found.items():
        assign(f"{args[0]}_{keyword}", values, variables)


SETTERS: dict[str, Callable[[list[str], Variables], None]] = {
    "set": run_set,
    "list": run_list,
    "file": run_file,
    "string": run_string,
    "get_filename_component": run_get_filename_component,
    "aux_source_directory": run_aux_source_directory,
    "cmake_parse_arguments": run_parse_arguments,
}
