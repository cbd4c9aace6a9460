"""What the real CMake builds and installs of a project: its file API, over stub packages that are written here."""

from __future__ import annotations

import json
import posixpath
import shutil
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

_KINDS = {"EXECUTABLE": "executable"}
_NOT_BUILT = frozenset({"UTILITY", "INTERFACE_LIBRARY"})
_PREFIX = "/prefix"
_MADE = (".rule", ".o")
"""Suffixes of what is no source: a file that stands for a command, and what another target makes."""
_STUBS = {
    "ament_cmake": """
option(BUILD_TESTING "" ON)
function(ament_target_dependencies)
endfunction()
macro(ament_package)
endmacro()
function(ament_add_gtest name)
  cmake_parse_arguments(ARG "" "TIMEOUT" "" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
endfunction()
function(ament_add_gmock name)
  add_executable(${name} ${ARGN})
endfunction()
""",
    "rclcpp": "",
    "ament_cmake_gtest": "",
    "ament_lint_auto": "",
    "ament_cmake_auto": """
macro(_auto_sources)
  cmake_parse_arguments(ARG "NO_TARGET_LINK_LIBRARIES" "DIRECTORY" "" ${ARGN})
  set(_found "")
  if(ARG_DIRECTORY)
    file(GLOB_RECURSE _found RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}
      ${ARG_DIRECTORY}/*.c ${ARG_DIRECTORY}/*.cc ${ARG_DIRECTORY}/*.cpp ${ARG_DIRECTORY}/*.cxx)
  endif()
endmacro()
macro(ament_auto_add_executable name)
  _auto_sources(${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS} ${_found})
  list(APPEND ${PROJECT_NAME}_EXECUTABLES ${name})
endmacro()
macro(ament_auto_add_library name)
  _auto_sources(${ARGN})
  add_library(${name} ${ARG_UNPARSED_ARGUMENTS} ${_found})
  list(APPEND ${PROJECT_NAME}_LIBRARIES ${name})
endmacro()
macro(ament_auto_package)
  cmake_parse_arguments(_A "INSTALL_TO_PATH" "" "INSTALL_TO_SHARE" ${ARGN})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/include)
    install(DIRECTORY include/ DESTINATION include)
  endif()
  install(TARGETS ${${PROJECT_NAME}_LIBRARIES} ARCHIVE DESTINATION lib LIBRARY DESTINATION lib RUNTIME DESTINATION bin)
  set(_where lib/${PROJECT_NAME})
  if(_A_INSTALL_TO_PATH)
    set(_where bin)
  endif()
  install(TARGETS ${${PROJECT_NAME}_EXECUTABLES} DESTINATION ${_where})
  foreach(_dir ${_A_INSTALL_TO_SHARE})
    install(DIRECTORY ${_dir} DESTINATION share/${PROJECT_NAME})
  endforeach()
endmacro()
""",
    "rclcpp_components": """
function(rclcpp_components_register_node target)
endfunction()
""",
    "catkin": """
set(CATKIN_ENABLE_TESTING ON)
set(CATKIN_PACKAGE_BIN_DESTINATION lib/${PROJECT_NAME})
set(CATKIN_PACKAGE_LIB_DESTINATION lib)
set(CATKIN_PACKAGE_SHARE_DESTINATION share/${PROJECT_NAME})
set(CATKIN_PACKAGE_INCLUDE_DESTINATION include/${PROJECT_NAME})
set(CATKIN_GLOBAL_BIN_DESTINATION bin)
set(CATKIN_GLOBAL_SHARE_DESTINATION share)
macro(catkin_package)
endmacro()
function(catkin_add_gtest name)
  cmake_parse_arguments(ARG "" "WORKING_DIRECTORY" "" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
endfunction()
function(catkin_install_python programs)
  cmake_parse_arguments(ARG "" "DESTINATION" "" ${ARGN})
  install(PROGRAMS ${ARG_UNPARSED_ARGUMENTS} DESTINATION ${ARG_DESTINATION})
endfunction()
""",
    "catkin_simple": """
macro(catkin_simple)
endmacro()
macro(cs_add_executable name)
  cmake_parse_arguments(ARG "NO_AUTO_LINK;NO_AUTO_DEP" "" "" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  list(APPEND ${PROJECT_NAME}_TARGETS ${name})
endmacro()
macro(cs_add_library name)
  cmake_parse_arguments(ARG "NO_AUTO_LINK;NO_AUTO_DEP;NO_AUTO_EXPORT" "" "" ${ARGN})
  add_library(${name} ${ARG_UNPARSED_ARGUMENTS})
  list(APPEND ${PROJECT_NAME}_TARGETS ${name})
endmacro()
macro(cs_install)
  install(TARGETS ${${PROJECT_NAME}_TARGETS} ${ARGN} ARCHIVE DESTINATION lib LIBRARY DESTINATION lib
    RUNTIME DESTINATION lib/${PROJECT_NAME})
  if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include)
    install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/include/ DESTINATION include FILES_MATCHING PATTERN "*.hpp")
  endif()
  foreach(_dir launch rviz urdf meshes maps worlds Media param)
    if(IS_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/${_dir})
      install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/${_dir}/ DESTINATION share/${PROJECT_NAME}/${_dir})
    endif()
  endforeach()
endmacro()
macro(cs_export)
endmacro()
""",
}
_NOTHING = (
    *("rosidl_generate_interfaces", "generate_parameter_library", "pluginlib_export_plugin_description_file"),
    *(
        "ament_export_dependencies",
        "ament_export_include_directories",
        "ament_export_libraries",
        "ament_export_targets",
    ),
    *("ament_python_install_package", "catkin_python_setup", "add_message_files", "add_service_files"),
    *("add_action_files", "generate_messages", "generate_dynamic_reconfigure_options", "add_rostest"),
    *("ament_lint_auto_find_test_dependencies", "ament_add_pytest_test", "rclcpp_components_register_nodes"),
    *("add_launch_test", "generate_parameter_module", "rosidl_get_typesupport_target"),
)
"""Commands of ROS that make no target and no install rule of their own."""
_LINKS = ("target_link_libraries", "add_dependencies")
"""Commands of CMake that fail over targets which are not there; fixtures name those of other packages."""
_BUILD_TOOLS = frozenset({"ament_cmake", "catkin"})
"""Stubs that bring the commands which make nothing."""
_STAND_IN = """
macro(stand_in method name)
  set(${name}_FOUND TRUE)
  include(@STUBS@/${name}/${name}Config.cmake OPTIONAL)
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER stand_in SUPPORTED_METHODS FIND_PACKAGE)
"""


@dataclass(frozen=True)
class Built:
    """A target: its kind, its sources from the root of the project, and the place of the command that made it."""

    kind: str
    sources: frozenset[str]
    place: str


@dataclass
class Truth:
    """What CMake says of a project; installs are (kind, item, destination)."""

    targets: dict[str, Built] = field(default_factory=dict)
    installs: set[tuple[str, str, str]] = field(default_factory=set)

    def document(self) -> dict[str, Any]:
        """What is recorded of it."""
        targets = {name: [each.kind, sorted(each.sources), each.place] for name, each in sorted(self.targets.items())}
        return {"targets": targets, "installs": sorted(self.installs)}

    @staticmethod
    def of(document: dict[str, Any]) -> Truth:
        """Read what was recorded."""
        targets = {name: Built(kind, frozenset(paths), at) for name, (kind, paths, at) in document["targets"].items()}
        return Truth(targets, {(kind, item, place) for kind, item, place in document["installs"]})


class Oracle:
    """Runs CMake in a folder of its own."""

    def __init__(self, program: str, folder: Path) -> None:
        self.program = program
        self.folder = folder
        self.stubs = folder / "stubs"
        self.platform: Path | None = None
        nothing = _empty(_NOTHING)
        self.stand_in = self.stubs / "stand_in.cmake"
        self.stubs.mkdir(parents=True, exist_ok=True)
        self.stand_in.write_text(_STAND_IN.replace("@STUBS@", str(self.stubs)) + nothing + _empty(_LINKS))
        for name, text in _STUBS.items():
            place = self.stubs / name
            place.mkdir(parents=True, exist_ok=True)
            (place / f"{name}Config.cmake").write_text(nothing + text if name in _BUILD_TOOLS else text)

    def ask(self, source: Path, is_fixture: bool = False) -> Truth | str:
        """Configure a project; the text is the error where CMake refuses it.

        Args:
            source: folder of the project.
            is_fixture: give it every package that it looks for, empty but for the stubs.
        """
        build = self.folder / "build"
        shutil.rmtree(build, ignore_errors=True)
        query = build / ".cmake/api/v1/query"
        query.mkdir(parents=True)
        (query / "codemodel-v2").touch()
        if self.platform is not None:
            # What CMake found of the compiler once holds for all projects.
            shutil.copytree(self.platform, build / "CMakeFiles" / self.platform.name)
        command = [self.program, "-S", str(source), "-B", str(build), "-G", "Ninja", "-Wno-dev", "-Wno-deprecated"]
        command += [f"-D{name}_DIR={self.stubs / name}" for name in _STUBS]
        command += [f"-DCMAKE_INSTALL_PREFIX={_PREFIX}", "-DCMAKE_POLICY_VERSION_MINIMUM=3.5"]
        command += [f"-DCMAKE_PROJECT_TOP_LEVEL_INCLUDES={self.stand_in}"] if is_fixture else []
        done = subprocess.run(command, check=False, capture_output=True, text=True)
        if done.returncode:
            return " ".join(done.stderr.split())[:300]
        self._keep_platform(build)
        return _truth(build)

    def _keep_platform(self, build: Path) -> None:
        if self.platform is None:
            found = next((build / "CMakeFiles").glob("[0-9]*"))
            self.platform = self.folder / "platform" / found.name
            shutil.copytree(found, self.platform, dirs_exist_ok=True)


def _empty(names: Iterable[str]) -> str:
    """Definitions of commands that do nothing."""
    return "".join(f"function({name})\nendfunction()\n" for name in names)


def _truth(build: Path) -> Truth:
    reply = build / ".cmake/api/v1/reply"
    model = json.loads(next(reply.glob("codemodel-v2-*.json")).read_text())
    (configuration,) = model["configurations"]
    truth = Truth()
    names = {}
    for entry in configuration["targets"]:
        target = json.loads((reply / entry["jsonFile"]).read_text())
        names[entry["id"]] = entry["name"]
        if target["type"] not in _NOT_BUILT:
            kind = _KINDS.get(target["type"], "library")
            paths = (each["path"] for each in target.get("sources", ()) if not each["path"].endswith(_MADE))
            sources = frozenset(_source(path, build) for path in paths)
            truth.targets[entry["name"]] = Built(kind, sources, _place(target))
    for entry in configuration["directories"]:
        folder = json.loads((reply / entry["jsonFile"]).read_text())
        for installer in folder.get("installers", ()):
            truth.installs |= _installed(installer, names)
    return truth


def _source(path: str, build: Path) -> str:
    """A path of the project, or one below the folder of the build."""
    return posixpath.normpath(path).replace(str(build), "${CMAKE_BINARY_DIR}")


def _installed(installer: dict[str, Any], names: dict[str, str]) -> set[tuple[str, str, str]]:
    if installer["type"] not in {"target", "file", "directory"}:
        return set()
    place = installer["destination"].removeprefix(f"{_PREFIX}/")
    if installer["type"] == "target":
        return {("targets", names[installer["targetId"]], place)}
    kind = {"file": "files"}.get(installer["type"], installer["type"])
    found = set()
    for path in installer["paths"]:
        # A path is a pair where the file gets another name, or where only the content of a folder is installed.
        text = path if isinstance(path, str) else path["from"]
        content = "/" if not isinstance(path, str) and path["to"] == "." else ""
        found.add((kind, posixpath.normpath(text) + content, place))
    return found


def _place(target: dict[str, Any]) -> str:
    """File and line of the command that made a target."""
    if "backtrace" not in target:
        return ""
    graph = target["backtraceGraph"]
    node = graph["nodes"][target["backtrace"]]
    return f"{graph['files'][node['file']]}:{node.get('line', 0)}"
