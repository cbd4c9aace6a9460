"""Which package of a tree a path lies in."""

from __future__ import annotations

from collections.abc import Collection


def owner_of(path: str, packages: Collection[str]) -> str | None:
    """Return the folder of the innermost package around a path; None where it lies in none.

    Args:
        path: relative to the root of the tree.
        packages: their folders, of which `.` is the root.
    """
    folder = path
    while folder:
        folder = folder.rpartition("/")[0]
        if folder in packages:
            return folder
    return "." if "." in packages else None


def concerns(path: str, package: str, packages: Collection[str]) -> bool:
    """Whether a path lies in a package, or in none of them, so that it may be of any."""
    return owner_of(path, packages) in {None, package}
