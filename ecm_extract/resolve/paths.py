"""Paths from the root of a tree, which itself is the empty path."""

from __future__ import annotations

import re
from posixpath import join, normpath
from typing import Final

_IS_DOTTED: Final = re.compile(r"(?:^|/)\.{0,2}(?:/|$)")
"""Parts of a path that normalising takes out; most paths have none."""


def tree_path(*parts: str) -> str:
    """Join and normalise."""
    if not any(part and _IS_DOTTED.search(part) for part in parts):
        return "/".join([part for part in parts if part])
    found = normpath(join(*parts))
    return "" if found == "." else found
