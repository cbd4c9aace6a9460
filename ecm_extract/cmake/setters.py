"""The table of commands that set variables."""

from __future__ import annotations

from typing import Final

from ecm_extract.cmake.argument_commands import parse_arguments, separate_arguments
from ecm_extract.cmake.change import Setter
from ecm_extract.cmake.file_commands import aux_source_directory, file_command, get_filename_component
from ecm_extract.cmake.files import BuildFiles
from ecm_extract.cmake.list_commands import run_list
from ecm_extract.cmake.property_commands import get_property, set_property
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
}
ALSO_CALLS: Final = frozenset({"option", "set_property", "file"})
"""Setters that state something beside."""


def setters(files: BuildFiles) -> dict[str, Setter]:
    """Return the commands that set variables, over the files of a tree."""
    return {**_SETTERS, "file": file_command(files), "aux_source_directory": aux_source_directory(files)}
