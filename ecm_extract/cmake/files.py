"""The files of a tree as CMake asks for them: is it there, what does a pattern find, what does it hold."""

from __future__ import annotations

import posixpath
from collections import defaultdict
from collections.abc import Callable, Iterable
from functools import cached_property
from typing import Final

from ecm_extract.cmake.values import SOURCE

MAX_FOUND: Final = 5_000


class BuildFiles:
    """Paths of a tree and the means to read one.

    Args:
        paths: of all files, relative to the root of the tree.
        read: gives the bytes of one, None when it cannot be read.
        absent: folders whose content this copy lacks, such as submodules that are not checked out.
    """

    def __init__(self, paths: Iterable[str], read: Callable[[str], bytes | None], absent: Iterable[str] = ()) -> None:
        self._paths = frozenset(paths)
        self._absent = tuple(absent)
        self.read = read

    def is_absent(self, path: str) -> bool:
        """Tell whether a path is in a folder whose content this copy lacks, so that nothing is known of it."""
        return any(f"{path}/".startswith(f"{folder}/") for folder in self._absent)

    def has(self, path: str) -> bool:
        """Tell whether a file of the tree is at a path."""
        return path in self._paths

    def is_folder(self, path: str) -> bool:
        """Tell whether a folder of the tree is at a path; the root is one."""
        return path in self._children or path == ""

    def inside(self, folder: str) -> list[str]:
        """Return the names in a folder, folders included, sorted."""
        return sorted(self._children.get(folder, ()))

    @cached_property
    def _children(self) -> dict[str, set[str]]:
        found: dict[str, set[str]] = defaultdict(set)
        for path in self._paths:
            child = path
            while child:
                folder, _, name = child.rpartition("/")
                is_new = folder not in found
                found[folder].add(name)
                child = folder if is_new else ""
        return dict(found)


def tree_path(text: str) -> str | None:
    """Return the path in the tree that an absolute path of CMake names; None outside of the tree."""
    if not text.startswith(SOURCE):
        return None
    path = posixpath.normpath(text)
    return path.removeprefix(SOURCE).lstrip("/") if path.startswith(SOURCE) else None


def absolute(text: str, folder: str) -> str:
    """Return a path as CMake makes it absolute: from a folder of the tree unless it is so already."""
    if text.startswith(("/", "\x01", "$")):
        return text
    return posixpath.normpath(posixpath.join(placed(folder), text)) if text else placed(folder)


def placed(path: str) -> str:
    """Return the absolute path of a file or folder of the tree."""
    return f"{SOURCE}/{path}" if path else SOURCE
