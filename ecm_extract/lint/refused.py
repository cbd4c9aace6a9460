"""Files that a strict reader refuses: of such a file nothing else can be said."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from ecm_parsers.cmake_blocks import nest
from ecm_parsers.cmake_facts import REFUSED
from ecm_parsers.cmake_tokens import parse_commands
from ecm_parsers.package_refused import refused_manifest
from ecm_parsers.python_refused import refused_by_every_python, refused_by_python3
from ecm_parsers.result import Diagnostic
from ecm_parsers.xml_tree import parse_xml
from ecm_parsers.yaml_refused import refused_by_every_yaml

from ecm_extract.lint.workspace import Workspace

_XML: Final = (".launch", ".launch.xml", ".xacro", ".urdf")
_YAML: Final = (".yaml", ".yml")
_MARKS: Final = (b"{{", b"{%", b"@(", b"<%", b"[ROBOT")
"""Of templates that somebody fills in."""

_Reader = Callable[[bytes], Diagnostic | None]


def refusal(path: str, workspace: Workspace) -> Diagnostic | None:
    """Return the first problem for which a strict reader refuses a file; None of templates and empty files."""
    reader = _reader(path, workspace)
    return workspace.files.parsed(path, reader) if reader is not None else None


def is_refused(path: str, workspace: Workspace) -> bool:
    """Tell whether a reader refuses a file of the tree."""
    return refusal(path, workspace) is not None


def _reader(path: str, workspace: Workspace) -> _Reader | None:
    """Who reads a file, by its name and by what its package is built for."""
    name = path.rpartition("/")[2]
    of_name = {"CMakeLists.txt": _of_cmake, "package.xml": _of_manifest}.get(name)
    if of_name is not None:
        return of_name
    if name.endswith(_XML):
        return _of_xml
    if name.endswith(_YAML):
        return _of_yaml
    if not _is_python(path, workspace):
        return None
    return _of_python3 if workspace.files.ros_of(path) == 2 else _of_every_python


def _is_python(path: str, workspace: Workspace) -> bool:
    """Launch files, modules and scripts, also those that only their first line tells."""
    if path.endswith(".py"):
        return True
    package = workspace.by_name.get(workspace.package_of(path))
    source = package.sources.get(path) if package is not None else None
    return source is not None and source.language == "python"


def _of_cmake(data: bytes) -> Diagnostic | None:
    if _is_template(data):
        return None
    parsed = parse_commands(data)
    diagnostics = list(parsed.diagnostics)
    nest(parsed.facts, diagnostics)
    return next((each for each in diagnostics if each.code in REFUSED), None)


def _of_xml(data: bytes) -> Diagnostic | None:
    diagnostics = () if _is_template(data) else parse_xml(data).diagnostics
    return next((each for each in diagnostics if each.code == "xml-malformed"), None)


def _of_manifest(data: bytes) -> Diagnostic | None:
    return None if _is_template(data) else _of_xml(data) or refused_manifest(data)


def _of_yaml(data: bytes) -> Diagnostic | None:
    return None if _is_template(data) else refused_by_every_yaml(data)


def _of_python3(data: bytes) -> Diagnostic | None:
    return _unless_filled_in(refused_by_python3(data), data)


def _of_every_python(data: bytes) -> Diagnostic | None:
    return _unless_filled_in(refused_by_every_python(data), data)


def _unless_filled_in(problem: Diagnostic | None, data: bytes) -> Diagnostic | None:
    """What marks a template is right in Python in most places, so that only the line that is refused tells."""
    lines = data.splitlines() if problem is not None else []
    line = lines[problem.line - 1] if problem is not None and problem.line <= len(lines) else b""
    return None if any(mark in line for mark in _MARKS) else problem


def _is_template(data: bytes) -> bool:
    return not data.strip() or any(mark in data for mark in _MARKS)
