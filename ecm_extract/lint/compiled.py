"""Which C++ sources a build may compile."""

from __future__ import annotations

from pathlib import PurePosixPath

from ecm_extract.lint.workspace import Workspace

_SOURCES = frozenset({".c", ".cc", ".cpp", ".cxx"})
_FOLDERS = (b"GLOB", b"aux_source_directory", b"ament_auto_add", b"foreach")


def is_compiled(path: str, workspace: Workspace) -> bool:
    """Tell whether a file may be part of a build: False for a C++ source that no CMake file of its package names."""
    package = workspace.by_name.get(workspace.package_of(path))
    name = PurePosixPath(path)
    if package is None or not package.cmake or name.suffix not in _SOURCES:
        return True
    texts = [workspace.files.read(each) or b"" for each in package.cmake]
    return any(name.stem.encode() in text or any(word in text for word in _FOLDERS) for text in texts)
