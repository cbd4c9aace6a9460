"""CMake calls that state what a package offers beside targets: interfaces, plugins, parameters."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator

from ecm_parsers.cmake_facts import (
    Dependency,
    FileReference,
    InterfaceFile,
    InterfaceKind,
    ParameterLibrary,
    PluginDescription,
)

from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.finding import found_packages
from ecm_extract.cmake.keywords import first, split

_INTERFACE_KINDS: dict[str, InterfaceKind] = {
    ".msg": "msg",
    ".srv": "srv",
    ".action": "action",
    ".idl": "idl",
}
_CATKIN_INTERFACES: dict[str, InterfaceKind] = {
    "add_message_files": "msg",
    "add_service_files": "srv",
    "add_action_files": "action",
}
_ROSIDL = frozenset({"rosidl_generate_interfaces"})
_ROSIDL_WORDS = frozenset(
    {"DEPENDENCIES", "LIBRARY_NAME", "ADD_LINTER_TESTS", "SKIP_INSTALL", "SKIP_GROUP_MEMBERSHIP_CHECK"}
)
_PARAMETER_LIBRARIES = frozenset({"generate_parameter_library", "generate_parameter_module"})
_GPU = frozenset({"CUDA", "CUDAToolkit", "TensorRT", "TENSORRT", "CUDNN", "cuda", "tensorrt"})


def interfaces(calls: tuple[Call, ...]) -> Iterator[InterfaceFile]:
    """Yield the interface files that are generated from (REP 149 / rosidl_cmake, genmsg)."""
    for call in calls:
        if call.name in _ROSIDL:
            for value in split(call.texts[1:], _ROSIDL_WORDS)[""]:
                # `BASE_DIR:relative/path` is the other form of an argument.
                path = call.file(value.rpartition(":")[2])
                kind = _INTERFACE_KINDS.get(posixpath.splitext(path)[1], "other")
                yield InterfaceFile(path, kind, call.line)
        elif call.name in _CATKIN_INTERFACES:
            yield from _catkin_interfaces(call, _CATKIN_INTERFACES[call.name])


def _catkin_interfaces(call: Call, kind: InterfaceKind) -> Iterator[InterfaceFile]:
    """`add_*_files([DIRECTORY dir] [FILES names])`; without names it is the whole folder."""
    groups = split(call.texts, frozenset({"DIRECTORY", "FILES", "NOINSTALL", "PACKAGE", "BASE_DIR"}))
    folder = first(groups, "DIRECTORY") or kind
    names = groups.get("FILES") or [f"*.{kind}"]
    for name in names:
        yield InterfaceFile(call.file(posixpath.join(folder, name)), kind, call.line)


def plugin_descriptions(calls: tuple[Call, ...]) -> Iterator[PluginDescription]:
    """Yield pluginlib description files exported by CMake (ROS 2)."""
    for call in calls:
        if call.name == "pluginlib_export_plugin_description_file" and len(call.args) > 1:
            for path in call.texts[1:]:
                yield PluginDescription(call.args[0], call.file(path), call.line)


def parameter_libraries(calls: tuple[Call, ...]) -> Iterator[ParameterLibrary]:
    """Yield the parameter declaration files that code is generated from."""
    for call in calls:
        if call.name in _PARAMETER_LIBRARIES and len(call.args) > 1:
            is_python = call.name.endswith("module")
            yield ParameterLibrary(call.args[0], call.file(call.texts[1]), call.line, is_python)


def reconfigure_files(calls: tuple[Call, ...]) -> Iterator[FileReference]:
    """Yield the `.cfg` files of dynamic_reconfigure."""
    for call in calls:
        if call.name == "generate_dynamic_reconfigure_options":
            for path in call.texts:
                yield FileReference(call.file(path), call.line)


def dependencies(calls: tuple[Call, ...]) -> Iterator[Dependency]:
    """Yield the packages that are searched for."""
    for call in calls:
        if call.name not in {"find_package", "ament_auto_find_package"} or not call.args:
            continue
        for name in found_packages(call.args):
            yield Dependency(name, call.line, call.is_test)


def gpu(calls: tuple[Call, ...]) -> Iterator[FileReference]:
    """Yield what the file asks of CUDA or TensorRT; `path` is the name."""
    for call in calls:
        if call.name in {"find_package", "find_library", "enable_language", "project"}:
            wanted = call.args[:1] if call.name == "find_package" else call.args
            yield from (FileReference(name, call.line) for name in wanted if name in _GPU)
        elif call.name.startswith("cuda_add_"):
            yield FileReference("CUDA", call.line)


def python_packages(calls: tuple[Call, ...]) -> Iterator[FileReference]:
    """Yield Python packages that CMake installs; `.` means what `setup.py` names."""
    for call in calls:
        if call.name == "ament_python_install_package" and call.args:
            groups = split(call.texts, frozenset({"PACKAGE_DIR", "VERSION", "SETUP_CFG", "DESTINATION"}))
            yield FileReference(call.file(first(groups, "PACKAGE_DIR") or call.texts[0]), call.line)
        elif call.name == "catkin_python_setup":
            yield FileReference(".", call.line)
