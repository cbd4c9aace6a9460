"""CMakeLists.txt and *.cmake: what is built, generated, exported and installed.

Source: cmake(1), ament_cmake, catkin, rosidl_cmake, pluginlib, rclcpp_components, generate_parameter_library.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from ecm_parsers import cmake_exports as exports
from ecm_parsers.cmake_facts import CmakeFile, Option, Subdirectory
from ecm_parsers.cmake_foreign import foreign_words
from ecm_parsers.cmake_keywords import relative
from ecm_parsers.cmake_run import Call, run
from ecm_parsers.cmake_targets import components, targets
from ecm_parsers.result import Parsed

REFUSED: Final = frozenset({"cmake-syntax", "cmake-unclosed", "cmake-unbalanced"})
"""Codes of what CMake stops at."""


def parse_cmake(data: bytes, inherited: Mapping[str, str] | None = None) -> Parsed[CmakeFile]:
    """Read one CMake file without executing it.

    Args:
        data: content of a CMakeLists.txt or *.cmake file.
        inherited: variables of the file that runs this one, from `variables_below`.

    Returns:
        Facts with the line of the call they come from; for calls in a function or macro of the same file, the
        line that calls it. Loops over known lists are unrolled within bounds.
    """
    evaluated = run(data, dict(inherited or {}))
    calls = evaluated.facts.calls
    name, version, line = _project(calls)
    facts = CmakeFile(
        project=name,
        version=version,
        line=line,
        targets=targets(calls),
        components=components(calls),
        plugin_descriptions=tuple(exports.plugin_descriptions(calls)),
        parameter_libraries=tuple(exports.parameter_libraries(calls)),
        interfaces=tuple(exports.interfaces(calls)),
        reconfigure_files=tuple(exports.reconfigure_files(calls)),
        installs=tuple(exports.installs(calls)),
        dependencies=tuple(exports.dependencies(calls)),
        subdirectories=tuple(_subdirectories(calls)),
        options=tuple(_options(calls)),
        gpu=tuple(exports.gpu(calls)),
        python_packages=tuple(exports.python_packages(calls)),
        variables=evaluated.facts.variables,
        foreign=tuple(dict.fromkeys(foreign_words(calls))),
        calls=calls,
        commands=evaluated.facts.commands,
        malformed=any(each.code in REFUSED for each in evaluated.diagnostics),
    )
    return Parsed(facts, evaluated.diagnostics)


def variables_below(facts: CmakeFile, folder: str) -> dict[str, str]:
    """Return the variables that a CMakeLists.txt in `folder` inherits, with source folders relative to it.

    Args:
        facts: of the file with the `add_subdirectory`.
        folder: path of the subdirectory, relative to that file.
    """
    parts = [part for part in relative(folder).split("/") if part not in {"", "."}]
    up = "./" + "/".join([".."] * len(parts)) if parts else "."
    return {name: _rebased(value, up) for name, value in facts.variables.items()}


def _rebased(value: str, up: str) -> str:
    """Prefix the items that came from a source folder: they are written `.` or `./...`."""
    if "." not in value:
        return value
    items = value.split(";")
    return ";".join(up + item[1:] if item == "." or item.startswith("./") else item for item in items)


def _project(calls: tuple[Call, ...]) -> tuple[str | None, str | None, int]:
    """Return name, version and line of `project()`."""
    for call in calls:
        if call.name == "project" and call.args:
            has_version = "VERSION" in call.args[:-1]
            version = call.args[call.args.index("VERSION") + 1] if has_version else None
            return call.args[0], version, call.line
    return None, None, 0


def _subdirectories(calls: tuple[Call, ...]) -> Iterator[Subdirectory]:
    for call in calls:
        if call.name in {"add_subdirectory", "include"} and call.args:
            yield Subdirectory(relative(call.args[0]), call.line, call.is_test, call.name == "include")


def _options(calls: tuple[Call, ...]) -> Iterator[Option]:
    for call in calls:
        if call.name == "option" and call.args:
            default = call.args[2] if len(call.args) > 2 else "OFF"
            yield Option(call.args[0], default, call.line)
