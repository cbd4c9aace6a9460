"""Lines of names in files of the workspace."""

from __future__ import annotations

from ecm_extract.lint.workspace import Workspace
from ecm_extract.requires import name_lines


def line_of_name(path: str, start: int, name: str, workspace: Workspace) -> int:
    """Return the line of a name in a file, see `ecm_extract.requires.name_lines`."""
    return name_lines.line_of_name(workspace.files.lines(path), start, name)
