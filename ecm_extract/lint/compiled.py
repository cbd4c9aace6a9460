"""Which C++ sources a build may compile."""

from __future__ import annotations

from pathlib import PurePosixPath

from ecm_extract.entities.cmake_words import calls_any, words_of
from ecm_extract.lint.workspace import Workspace

_SOURCES = frozenset({".c", ".cc", ".cpp", ".cxx"})
_LISTING = frozenset({"aux_source_directory", "ament_auto_add_executable", "ament_auto_add_library", "foreach"})
_PATTERNS = frozenset({"GLOB", "GLOB_RECURSE"})


def is_compiled(path: str, workspace: Workspace) -> bool:
    """Tell whether a file may be part of a build: False for a C++ source that no CMake file of its package names."""
    package = workspace.by_name.get(workspace.package_of(path))
    name = PurePosixPath(path)
    if package is None or not package.cmake or name.suffix not in _SOURCES or calls_any(package, _LISTING):
        return True
    return any(name.stem in word or word in _PATTERNS for word in words_of(package))
