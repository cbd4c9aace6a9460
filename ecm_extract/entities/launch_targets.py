"""Which file of which package a launch file includes, as far as it says so itself."""

from __future__ import annotations

import re
from pathlib import PurePosixPath
from posixpath import normpath
from typing import Final

from ecm_parsers.launch.templates import plain_text, written
from ecm_parsers.template import Substitution, Template

FOUND: Final = re.compile(r"\$\((?:find|find_prefix) ([^\s$()]+)\)(/(?:.*/)?)([^/$()]+)$", re.DOTALL)
"""A file of a package: the package, the folders, the name, which stands there as a whole."""
OUTSIDE: Final = "/../"
"""Of folders that lead out of the package that is named."""
_ABOVE: Final = ".."


def included_file(path: Template, package: str, own: str) -> tuple[str, str] | None:
    """Return the package of an included file and its path from there; a folder may hold what only the launch knows.

    Args:
        path: as it is written.
        package: that the including file is of.
        own: the path of that file from its package.
    """
    first = path[0] if path else None
    if isinstance(first, Substitution) and first.kind == "dirname":
        below = plain_text(path[1:])
        target = normpath(f"{PurePosixPath(own).parent}/{below}") if below else _ABOVE
        return None if target.startswith(_ABOVE) else (package, target)
    found = FOUND.search(written(path))
    if found is None or OUTSIDE in found[2]:
        return None
    return found[1], f"{found[2].lstrip('/')}{found[3]}"
