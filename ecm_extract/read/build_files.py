"""CMakeLists.txt files in the order CMake runs them, and the Python packaging files."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from ecm_parsers.cmake_facts import CmakeFile
from ecm_parsers.python_metadata import parse_pyproject, parse_setup_cfg
from ecm_parsers.python_setup import parse_setup_py
from ecm_parsers.python_setup_facts import PythonSetup
from ecm_parsers.result import Parsed

from ecm_extract.cmake import BuildFiles, evaluate, stated
from ecm_extract.discover import PackageRoot
from ecm_extract.tree import FileDiagnostic, Tree, printable


class FileParser(Protocol):
    """What reads one file of the tree."""

    def parse(self, path: str, parser: Callable[[bytes], Parsed[Any]]) -> Any:
        """Return the facts of one file, None when it cannot be read."""


def read_cmake(files: BuildFiles, root: PackageRoot, tree: Tree) -> dict[str, CmakeFile]:
    """Return the CMake files of a package by path, in the order in which they run."""
    listed = {entry.path for entry in root.files}
    top = f"{root.path}/CMakeLists.txt" if root.path else "CMakeLists.txt"
    if top not in listed:
        return {}
    evaluation = evaluate(files, top)
    for path, diagnostics in evaluation.diagnostics.items():
        for each in diagnostics:
            tree.report(FileDiagnostic(each.severity, each.code, printable(path), each.line, each.message))
    return stated(evaluation)


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
