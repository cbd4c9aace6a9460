"""Modules and files of the tree that Python launch files read while they are read."""

from __future__ import annotations

from functools import cache
from importlib import resources

from ecm_parsers.template import Template

from ecm_extract.system.budget import Budget
from ecm_extract.system.files import TREE, Files
from ecm_extract.system.scope import Scope
from ecm_extract.system.substitute import Substituter


class LaunchSources:
    """What the launch file `path` can import and open, where it is started in a scope.

    Attributes:
        read: paths of the files of the tree that it has read.
    """

    def __init__(self, files: Files, path: str, scope: Scope, budget: Budget) -> None:
        self._files = files
        self._path = path
        self.read: set[str] = set()
        self._substituter = Substituter(files, path, scope.inner(), budget)

    def declared(self, name: str, default: Template) -> None:
        """Take note of an argument of the launch file; what it is started with goes first."""
        self._substituter.arguments.setdefault(name, self._substituter.text(default))

    def module(self, name: str) -> bytes | None:
        """Return the source of an importable module by its dotted name: a stand-in of ours, or one of the tree."""
        known = stand_in(name.split(".")[0])
        if known is not None:
            return known
        return self._content(self._files.module(name, self._path))

    def file(self, path: Template) -> bytes | None:
        """Return the content of a file of the tree by its path as a launch file writes it."""
        return self._content(self._found(path))

    def exists(self, path: Template) -> bool | None:
        """Return whether the tree holds a file, None for a path that is outside of it."""
        text = self._substituter.text(path)
        return self._found(path) is not None if text.known and text.text.startswith(TREE) else None

    def names(self, folder: Template) -> tuple[str, ...] | None:
        """Return the names of the files of a folder of the tree."""
        text = self._substituter.text(folder)
        return self._files.names(text.text) if text.known and text.text.startswith(TREE) else None

    def _content(self, path: str | None) -> bytes | None:
        if path is None:
            return None
        self.read.add(path)
        return self._files.read(path)

    def _found(self, path: Template) -> str | None:
        text = self._substituter.text(path)
        return self._files.find(text.text) if text.known else None


@cache
def stand_in(name: str) -> bytes | None:
    """Return what stands for a public module of launch helpers, None for any other module."""
    entry = resources.files("ecm_extract.system") / "stand_ins" / f"{name}.py.txt"
    return entry.read_bytes() if name.isidentifier() and entry.is_file() else None
