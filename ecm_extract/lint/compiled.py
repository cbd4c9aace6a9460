"""Which C++ sources a build may compile."""

from __future__ import annotations

from pathlib import PurePosixPath

from ecm_extract.cmake.sources import built_sources
from ecm_extract.lint.workspace import Workspace

_SOURCES = frozenset({".c", ".cc", ".cpp", ".cxx"})


def is_compiled(path: str, workspace: Workspace) -> bool:
    """Tell whether a file may be part of a build: False for a C++ source that no target of its package has."""
    package = workspace.by_name.get(workspace.package_of(path))
    if package is None or not package.cmake or PurePosixPath(path).suffix not in _SOURCES:
        return True
    built = built_sources(package.cmake)
    return built is None or path in built
