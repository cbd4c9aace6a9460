"""Lines of names: an element or call of several lines is told by the line that has the name."""

from __future__ import annotations

import re
from typing import Final

from ecm_extract.lint.workspace import Workspace

_REACH: Final = 12
"""Lines of one element or call that are looked through."""


def line_of_name(path: str, start: int, name: str, workspace: Workspace) -> int:
    """Return the first line from `start` on that has a name as a whole word; `start` where none has it.

    Args:
        path: of the file.
        start: 1-based line of the element or call.
        name: as it is written there.
        workspace: reads the file.
    """
    lines = (workspace.files.read(path) or b"").splitlines()[start - 1 : start - 1 + _REACH]
    word = re.compile(rb"(?<![\w.])" + re.escape(name.encode()) + rb"(?![\w.])")
    return next((start + at for at, line in enumerate(lines) if word.search(line)), start)
