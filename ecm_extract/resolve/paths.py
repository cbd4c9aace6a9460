"""Paths from the root of a tree, which itself is the empty path."""

from __future__ import annotations

from posixpath import join, normpath


def tree_path(*parts: str) -> str:
    """Join and normalise."""
    found = normpath(join(*parts))
    return "" if found == "." else found
