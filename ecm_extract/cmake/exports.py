"""CMake calls that state what a package offers beside targets: interfaces, plugins, parameters, installs."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Mapping

import msgspec
from ecm_parsers.cmake_facts import (
    Dependency,
    FileReference,
    Install,
    InstallKind,
    InterfaceFile,
    InterfaceKind,
    ParameterLibrary,
    PluginDescription,
    Target,
)

from ecm_extract.cmake.calls import Call
from ecm_extract.cmake.keywords import first, split
from ecm_extract.cmake.state import both
from ecm_extract.cmake.values import PREFIX

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
_INSTALL_KINDS: dict[str, InstallKind] = {
    "TARGETS": "targets",
    "PROGRAMS": "programs",
    "DIRECTORY": "directory",
    "FILES": "files",
}
_INSTALL_WORDS = frozenset(
    {"DESTINATION", "EXPORT", "RUNTIME", "LIBRARY", "ARCHIVE", "INCLUDES", "PERMISSIONS", "PATTERN", "REGEX"}
    | {"FILES_MATCHING", "USE_SOURCE_PERMISSIONS", "OPTIONAL", "COMPONENT", "RENAME", "FILE_PERMISSIONS"}
    | {"DIRECTORY_PERMISSIONS", "CONFIGURATIONS", "TYPE", "PUBLIC_HEADER", "BUNDLE", "OBJECTS", "EXCLUDE"}
)
_FIND_WORDS = frozenset(
    {
        "REQUIRED",
        "QUIET",
        "COMPONENTS",
        "OPTIONAL_COMPONENTS",
        "CONFIG",
        "MODULE",
        "EXACT",
        "NO_MODULE",
        "HINTS",
    }
)
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


_AUTO_TARGETS = frozenset({"ament_auto_add_library", "ament_auto_add_executable"})
"""What `ament_auto_package` installs by itself."""


def installs(calls: tuple[Call, ...], targets: Mapping[str, Target]) -> Iterator[Install]:
    """Yield what is installed where; targets that go to several folders have a rule for each.

    Args:
        calls: of one file.
        targets: of the whole build, by name.
    """
    for call in calls:
        if call.name == "install" and call.args and call.args[0] in _INSTALL_KINDS:
            for rule in _each(call, _INSTALL_KINDS[call.args[0]]):
                yield from _parted(rule, call, targets) if rule.kind == "targets" else (rule,)
        elif call.name == "catkin_install_python":
            yield from _each(call, "python")
        elif call.name == "ament_auto_package":
            made = (other.args[0] for other in calls if other.name in _AUTO_TARGETS and other.args)
            yield Install("targets", tuple(made), "", call.line)


def _each(call: Call, kind: InstallKind) -> Iterator[Install]:
    """One rule, or one for each of the arguments that builds may have."""
    for at, texts in enumerate((call.texts, *call.others)):
        by_default = both(call.by_default, (at == 0) if call.sure else None)
        yield _install(call, kind, texts[texts[:1] == ("PROGRAMS",) if kind == "python" else 1 :], by_default)


def _install(call: Call, kind: InstallKind, args: tuple[str, ...], by_default: bool | None) -> Install:
    groups = split(args, _INSTALL_WORDS)
    word = call.word if kind == "targets" else call.file
    return Install(
        kind=kind,
        items=tuple(word(value) for value in groups[""]),
        destination=_below_prefix(_destination(args), call),
        line=call.line,
        conditions=call.conditions,
        by_default=by_default,
        words=tuple(word for word in args if word in _INSTALL_WORDS),
        renamed=call.word(first(groups, "RENAME") or ""),
    )


def _destination(args: tuple[str, ...]) -> str:
    """Return the folder of programs (RUNTIME) when it is told, else the first one."""
    found = {args[i - 1]: args[i + 1] for i, arg in enumerate(args[:-1]) if arg == "DESTINATION"}
    return found.get("RUNTIME") or next(iter(found.values()), "")


def _parted(rule: Install, call: Call, targets: Mapping[str, Target]) -> Iterator[Install]:
    """Programs go where RUNTIME says, shared libraries where LIBRARY does, others where ARCHIVE does."""
    words = call.texts
    told = {words[at - 1]: words[at + 1] for at, word in enumerate(words[:-1]) if word == "DESTINATION"}
    places: dict[str, list[str]] = {}
    for item in rule.items:
        place = told.get(_artefact(targets.get(item)))
        places.setdefault(rule.destination if place is None else _below_prefix(place, call), []).append(item)
    for place, items in places.items():
        yield msgspec.structs.replace(rule, items=tuple(items), destination=place)


def _artefact(target: Target | None) -> str:
    if target is None or target.kind != "library":
        return "RUNTIME"
    return "ARCHIVE" if target.is_shared is False else "LIBRARY"


def _below_prefix(destination: str, call: Call) -> str:
    return call.word(destination.removeprefix(PREFIX).lstrip("/") if destination.startswith(PREFIX) else destination)


def dependencies(calls: tuple[Call, ...]) -> Iterator[Dependency]:
    """Yield the packages that are searched for."""
    for call in calls:
        if call.name not in {"find_package", "ament_auto_find_package"} or not call.args:
            continue
        names = [call.args[0]]
        if call.args[0] == "catkin":
            groups = split(call.args[1:], _FIND_WORDS)
            # catkin takes components after REQUIRED too.
            after = ("COMPONENTS", "OPTIONAL_COMPONENTS", "REQUIRED")
            names += [name for word in after for name in groups.get(word, [])]
        for name in dict.fromkeys(names):
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
