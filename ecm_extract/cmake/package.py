"""What the CMake files of a package state: what is built, generated, exported and installed, by file.

Source: cmake(1), ament_cmake, catkin, rosidl_cmake, pluginlib, rclcpp_components, generate_parameter_library.
"""

from __future__ import annotations

from collections.abc import Iterator

import msgspec
from ecm_parsers.cmake_facts import REFUSED, CmakeFile, Command, Option, Subdirectory, Target, Unknown

from ecm_extract.cmake import exports
from ecm_extract.cmake.auto_package import projects_of
from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.foreign import foreign_words
from ecm_extract.cmake.installs import installs
from ecm_extract.cmake.run import Evaluation, Unread
from ecm_extract.cmake.targets import components, targets


def stated(evaluation: Evaluation) -> dict[str, CmakeFile]:
    """Return the facts of each file that ran; paths are relative to the folder of the file.

    Facts have the line of the call they come from, of the outermost one where functions are called.
    """
    calls: dict[str, list[Call]] = {path: [] for path in evaluation.paths}
    for call in evaluation.calls:
        calls[call.path].append(call)
    made = targets(evaluation.calls, evaluation.files)
    unread = {path: tuple(each for each in evaluation.unread if each.path == path) for path in calls}
    refused = {path for path, told in evaluation.diagnostics.items() if any(each.code in REFUSED for each in told)}
    by_name = {target.name: target for own in made.values() for target in own}
    projects = projects_of(evaluation.calls)
    files = {path: _file(tuple(own), made.get(path, ()), unread[path]) for path, own in calls.items()}
    return {
        path: msgspec.structs.replace(
            file,
            malformed=path in refused,
            installs=tuple(installs(tuple(calls[path]), by_name, projects, evaluation.files)),
        )
        for path, file in files.items()
    }


def _file(calls: tuple[Call, ...], made: tuple[Target, ...], unread: tuple[Unread, ...]) -> CmakeFile:
    name, version, line = _project(calls)
    return CmakeFile(
        project=name,
        version=version,
        line=line,
        targets=made,
        components=components(calls),
        plugin_descriptions=tuple(exports.plugin_descriptions(calls)),
        parameter_libraries=tuple(exports.parameter_libraries(calls)),
        interfaces=tuple(exports.interfaces(calls)),
        reconfigure_files=tuple(exports.reconfigure_files(calls)),
        dependencies=tuple(exports.dependencies(calls)),
        subdirectories=tuple(_subdirectories(calls)),
        options=tuple(_options(calls)),
        gpu=tuple(exports.gpu(calls)),
        python_packages=tuple(exports.python_packages(calls)),
        commands=tuple(Command(call.name, call.args, call.line, call.is_test) for call in calls),
        unknown=tuple(Unknown(entry.line, entry.reason) for entry in unread),
        foreign=tuple(dict.fromkeys(foreign_words(calls))),
    )


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
            yield Subdirectory(call.file(call.texts[0]), call.line, call.is_test, call.name == "include")


def _options(calls: tuple[Call, ...]) -> Iterator[Option]:
    for call in calls:
        if call.name == "option" and call.args:
            default = call.args[2] if len(call.args) > 2 else "OFF"
            yield Option(call.args[0], default, call.line)
