"""Files that a strict reader refuses: of such a file nothing else can be said."""

from __future__ import annotations

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


def refusal(path: str, data: bytes) -> Diagnostic | None:
    """Return the first problem for which a strict reader refuses a file; None of templates and empty files."""
    if not data.strip() or any(mark in data for mark in _MARKS):
        return None
    if path.rpartition("/")[2] == "CMakeLists.txt":
        return next((each for each in _unread(data) if each.code in REFUSED), None)
    if f"/{path}".endswith(XML):
        return next((each for each in parse_xml(data).diagnostics if each.code == "xml-malformed"), None)
    return None


def _unread(data: bytes) -> list[Diagnostic]:
    parsed = parse_commands(data)
    diagnostics = list(parsed.diagnostics)
    nest(parsed.facts, diagnostics)
    return diagnostics


def is_refused(path: str, workspace: Workspace) -> bool:
    """Tell whether a reader refuses a file of the tree."""
    return refusal(path, workspace.files.read(path) or b"") is not None
