"""The table of commands that set variables."""

from __future__ import annotations

from typing import Final

from ecm_extract.cmake.argument_commands import parse_arguments, separate_arguments
from ecm_extract.cmake.change import Setter
from ecm_extract.cmake.file_commands import aux_source_directory, file_command, get_filename_component
from ecm_extract.cmake.files import BuildFiles
from ecm_extract.cmake.list_commands import run_list
from ecm_extract.cmake.option_commands import dependent_option
from ecm_extract.cmake.path_commands import run_path
from ecm_extract.cmake.policies import cmake_policy
from ecm_extract.cmake.property_commands import (
    add_executable,
    add_library,
    get_directory_property,
    get_property,
    get_target_property,
    set_property,
    set_target_properties,
    target_sources,
)
from ecm_extract.cmake.set_commands import math, option, set_variable, unset_variable
from ecm_extract.cmake.string_commands import run_string

_SETTERS: Final[dict[str, Setter]] = {
    "set": set_variable,
    "unset": unset_variable,
    "option": option,
    "math": math,
    "list": run_list,
    "string": run_string,
    "get_filename_component": get_filename_component,
    "cmake_parse_arguments": parse_arguments,
    "separate_arguments": separate_arguments,
    "set_property": set_property,
    "get_property": get_property,
    "get_target_property": get_target_property,
    "get_directory_property": get_directory_property,
    "set_target_properties": set_target_properties,
    "add_executable": add_executable,
    "add_library": add_library,
    "target_sources": target_sources,
    "cmake_path": run_path,
    "cmake_dependent_option": dependent_option,
    "cmake_policy": cmake_policy,
}
ALSO_CALLS: Final = frozenset(
    {"option", "cmake_dependent_option", "set_property", "set_target_properties", "file"}
    | {"add_executable", "add_library", "target_sources"}
)
"""Setters that state something beside."""


def setters(files: BuildFiles) -> dict[str, Setter]:
    """Return the commands that set variables, over the files of a tree."""
    return {**_SETTERS, "file": file_command(files), "aux_source_directory": aux_source_directory(files)}
