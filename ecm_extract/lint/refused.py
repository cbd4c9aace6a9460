"""Files that a strict reader refuses: of such a file nothing else can be said."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from ecm_parsers.cmake_blocks import nest
from ecm_parsers.cmake_facts import REFUSED
from ecm_parsers.cmake_tokens import parse_commands
from ecm_parsers.result import Diagnostic
from ecm_parsers.xml_tree import parse_xml

from ecm_extract.lint.workspace import Workspace

XML: Final = (".launch", ".launch.xml", ".xacro", ".urdf", "/package.xml")
_MARKS: Final = (b"{{", b"{%", b"@(", b"<%", b"[ROBOT")
"""Of templates that somebody fills in."""


def refusal(path: str, workspace: Workspace) -> Diagnostic | None:
    """Return the first problem for which a strict reader refuses a file; None of templates and empty files."""
    parser = _parser(path)
    return workspace.files.parsed(path, parser) if parser is not None else None


def is_refused(path: str, workspace: Workspace) -> bool:
    """Tell whether a reader refuses a file of the tree."""
    return refusal(path, workspace) is not None


def _parser(path: str) -> Callable[[bytes], Diagnostic | None] | None:
    if path.rpartition("/")[2] == "CMakeLists.txt":
        return _of_cmake
    return _of_xml if f"/{path}".endswith(XML) else None


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


def _is_template(data: bytes) -> bool:
    return not data.strip() or any(mark in data for mark in _MARKS)
