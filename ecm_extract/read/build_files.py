"""CMakeLists.txt files in the order CMake runs them, and the Python packaging files."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import PurePosixPath
from typing import Any, Protocol

from ecm_parsers.cmake import parse_cmake, variables_below
from ecm_parsers.cmake_facts import CmakeFile
from ecm_parsers.python_metadata import parse_pyproject, parse_setup_cfg
from ecm_parsers.python_setup import parse_setup_py
from ecm_parsers.python_setup_facts import PythonSetup
from ecm_parsers.result import Parsed

from ecm_extract.discover import PackageRoot

MAX_FILES = 200


class FileParser(Protocol):
    """What reads one file of the tree."""

    def parse(self, path: str, parser: Callable[[bytes], Parsed[Any]]) -> Any:
        """Return the facts of one file, None when it cannot be read."""


def read_cmake(reader: FileParser, root: PackageRoot) -> dict[str, CmakeFile]:
    """Return the CMake files of a package by path, subdirectories after the file that adds them."""
    listed = {entry.path for entry in root.files}
    top = f"{root.path}/CMakeLists.txt" if root.path else "CMakeLists.txt"
    pending: list[tuple[str, dict[str, str]]] = [(top, {})]
    found: dict[str, CmakeFile] = {}
    while pending and len(found) < MAX_FILES:
        path, inherited = pending.pop(0)
        if path in found or path not in listed:
            continue
        facts: CmakeFile | None = reader.parse(path, _with(inherited))
        if facts is None:
            continue
        found[path] = facts
        for entry in facts.subdirectories:
            if not entry.is_include:
                below = str(PurePosixPath(path).parent / entry.path / "CMakeLists.txt")
                pending.append((below, variables_below(facts, entry.path)))
    return found


def _with(inherited: dict[str, str]) -> Callable[[bytes], Parsed[CmakeFile]]:
    return lambda data: parse_cmake(data, inherited)


def read_setups(reader: FileParser, root: PackageRoot) -> dict[str, PythonSetup]:
    """Return what setup.py, setup.cfg and pyproject.toml of a package state."""
    listed = {entry.path for entry in root.files}
    folder = f"{root.path}/" if root.path else ""
    parsers = {
        "setup.py": parse_setup_py,
        "setup.cfg": parse_setup_cfg,
        "pyproject.toml": parse_pyproject,
    }
    found = {}
    for name, parser in parsers.items():
        facts = reader.parse(folder + name, parser) if folder + name in listed else None
        if facts is not None:
            found[folder + name] = facts
    return found
