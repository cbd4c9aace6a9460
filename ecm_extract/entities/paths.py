"""Where files lie in their package."""

from __future__ import annotations


def inside(path: str, root: str) -> str:
    """Return a path relative to the folder of its package."""
    return path.removeprefix(f"{root}/") if root else path
