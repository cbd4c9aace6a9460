"""Files as launch files name them: by package, or beside the file that names them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import PurePosixPath
from typing import TypeVar, cast

from ecm_extract.system.installed import Installed
from ecm_extract.system.package_folders import PackageFolder
from ecm_extract.tree import Tree, left_out

Read = TypeVar("Read")

TREE = "tree:"
"""Prefix of a path that is in the tree, so that a path of the machine is never taken for one."""

TEMPLATES = (".in", ".em", ".jinja", ".jinja2", ".template")
"""Endings of files that a build fills in and installs without them."""

MAX_NEIGHBOUR = 256_000
"""Size in bytes of a file that is read because another one of its folder is."""


class Files:
    """Finds and reads files of one tree."""

    def __init__(self, tree: Tree, packages: Sequence[PackageFolder]) -> None:
        self._tree = tree
        self._roots = {package.name: package.path for package in packages}
        self._ros = {package.path: package.ros for package in packages}
        self._installed = Installed(row for package in packages for row in package.copied)
        self._paths = {entry.path for entry in tree.files()}
        self._stored = {entry.path: entry.size or 0 for entry in tree.files() if entry.identity is not None}
        self._by_name: dict[str, list[str]] = {}
        for path in sorted(self._paths):
            self._by_name.setdefault(PurePosixPath(path).name, []).append(path)
        self._contents: dict[str, bytes | None] = {}
        self._folders: dict[tuple[str, str], list[str]] = {}
        self._parsed: dict[tuple[str, str], object] = {}

    def share(self, package: str) -> str | None:
        """Return the marked path of a package's share folder, None when the tree does not hold the package."""
        root = self._roots.get(package)
        return None if root is None else f"{TREE}{root}"

    def folder(self, path: str) -> str:
        """Return the marked path of the folder of a file of the tree."""
        return TREE + path.rpartition("/")[0]

    def find(self, text: str) -> str | None:
        """Return the path in the tree of a marked path; a file that is installed elsewhere is found by its name."""
        if not text.startswith(TREE):
            return None
        path = _normal(text[len(TREE) :])
        if path in self._paths:
            return path
        copied = next((each for each in self._installed.sources(path) if each in self._paths), None)
        if copied is not None:
            return copied
        root = self._root(path)
        beside = [entry for entry in self._by_name.get(PurePosixPath(path).name, ()) if self._root(entry) == root]
        if len(beside) != 1:
            beside = [entry for entry in beside if PurePosixPath(entry).parent.name == PurePosixPath(path).parent.name]
        return beside[0] if len(beside) == 1 else None

    def is_elsewhere(self, text: str) -> bool:
        """Tell whether a path that was not found may exist all the same.

        It may be on the machine, be made by the build, or be a file that a partial checkout has left out.
        """
        if text.startswith(("/", "~")) or any(self.find(text + ending) is not None for ending in TEMPLATES):
            return True
        return text.startswith(TREE) and self.is_left_out(_normal(text[len(TREE) :]))

    def is_left_out(self, path: str) -> bool:
        """Tell whether git tracks a file, or files below a folder, that the checkout lacks."""
        return path in self._left_out or any(name.startswith(f"{path}/") for name in self._left_out)

    @cached_property
    def _left_out(self) -> frozenset[str]:
        return left_out(self._tree)

    def is_beside(self, path: str, text: str) -> bool:
        """Tell whether a path that is written without a folder to start from is there beside the file that names it."""
        return not text.startswith((TREE, "/")) and self.find(f"{self.folder(path)}/{text}") is not None

    def candidates(self, text: str) -> list[str]:
        """Return the paths in the tree that a marked path with `{name}` parts can mean."""
        if not text.startswith(TREE):
            return []
        pattern = _wildcards(_normal(text[len(TREE) :]))
        return sorted(path for path in self._paths if fnmatchcase(path, pattern))

    def globbed(self, text: str) -> list[str]:
        """Return the paths in the tree that a marked path with `*`, `?` and `[...]` means, in order."""
        if not text.startswith(TREE):
            return []
        pattern = _normal(text[len(TREE) :])
        depth = pattern.count("/")
        return sorted(path for path in self._paths if path.count("/") == depth and fnmatchcase(path, pattern))

    def in_package(self, package: str, name: str) -> str | None:
        """Return the file of a package with this name, as `roslaunch package file` looks it up."""
        root = self._roots.get(package)
        found = [entry for entry in self._by_name.get(PurePosixPath(name).name, ()) if self._root(entry) == root]
        return min(found, key=len) if root is not None and found else None

    def names(self, text: str) -> tuple[str, ...]:
        """Return the names of the files of a folder by its marked path."""
        folder = (_normal(text[len(TREE) :]) + "/").lstrip("/")
        below = (path.removeprefix(folder) for path in self._paths if path.startswith(folder))
        return tuple(sorted(name for name in below if "/" not in name))

    def module(self, name: str, beside: str) -> str | None:
        """Return the path of a Python module by its dotted name.

        Args:
            name: dotted.
            beside: path of the file that imports it; a module of one part is sought in its folder.
        """
        tail = name.replace(".", "/")
        wanted = (f"{tail}.py", f"{tail}/__init__.py")
        folder = beside.rpartition("/")[0]
        near = [f"{folder}/{each}".lstrip("/") for each in wanted]
        roots = [root for parent in self._roots.values() for root in (parent, f"{parent}/src".lstrip("/"))]
        installed = [f"{root}/{each}".lstrip("/") for root in roots for each in wanted]
        return next((path for path in (*near, *installed) if path in self._paths), None)

    def read(self, path: str) -> bytes | None:
        """Return the bytes of a file of the tree, None when it cannot be read."""
        if path not in self._contents:
            self._contents[path] = None
            self._contents.update(self._tree.read_many(self._with_neighbours(path)))
        return self._contents[path]

    def _with_neighbours(self, path: str) -> list[str]:
        """Of a ref also the small files of that kind in the same folder: a git process for each costs more."""
        if path not in self._stored:
            return [path]
        place = PurePosixPath(path)
        suffix = place.suffix
        return [path, *(name for name in self._kin(str(place.parent), suffix) if name not in self._contents)]

    def _kin(self, folder: str, suffix: str) -> list[str]:
        if not self._folders:
            for name, size in self._stored.items():
                head, _, last = name.rpartition("/")
                if size <= MAX_NEIGHBOUR:
                    self._folders.setdefault((head or ".", PurePosixPath(last).suffix), []).append(name)
        return self._folders.get((folder, suffix), [])

    def parsed(self, path: str, parser: Callable[[bytes], Read]) -> Read | None:
        """Return what a parser makes of a file, once for each parser; None when the file cannot be read."""
        key = (path, parser.__qualname__)
        if key not in self._parsed:
            data = self.read(path)
            self._parsed[key] = parser(data) if data is not None else None
        return cast("Read | None", self._parsed[key])

    def lines(self, path: str) -> list[bytes]:
        """Return the lines of a file; none of one that cannot be read."""
        return (self.read(path) or b"").splitlines()

    def package_path(self, name: str) -> str | None:
        """Return the folder of a package in the tree, None when the tree does not hold it."""
        return self._roots.get(name)

    def package_of(self, path: str) -> str | None:
        """Return the name of the package that a file belongs to."""
        root = self._root(path)
        return next((name for name, entry in self._roots.items() if entry == root), None)

    def ros_of(self, path: str) -> int | None:
        """Return the ROS version of the package that a file belongs to."""
        root = self._root(path)
        return None if root is None else self._ros.get(root)

    def _root(self, path: str) -> str | None:
        """Return the folder of the innermost package around a path."""
        for parent in PurePosixPath(path).parents:
            text = "" if str(parent) == "." else str(parent)
            if text in self._ros:
                return text
        return None


def _wildcards(text: str) -> str:
    """Return a path with `*` for each part in braces, nested ones included."""
    found, depth = [], 0
    for char in text:
        if char == "{":
            found += ["*"] if depth == 0 else []
            depth += 1
        elif char == "}":
            depth -= 1
        elif depth == 0:
            found.append(f"[{char}]" if char in "*?[" else char)
    return "".join(found)


def _normal(path: str) -> str:
    parts: list[str] = []
    for part in PurePosixPath(path).parts:
        if part == "..":
            parts[-1:] = []
        elif part not in {".", "/"}:
            parts.append(part)
    return "/".join(parts)
