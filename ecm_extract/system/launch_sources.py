"""Modules and files of the tree that Python launch files read while they are read."""

from __future__ import annotations

from ecm_parsers.launch.model import Template

from ecm_extract.system.files import Files
from ecm_extract.system.substitute import Substituter


class LaunchSources:
    """What the launch file `path` can import and open."""

    def __init__(self, files: Files, path: str) -> None:
        self._files = files
        self._path = path
        self._substituter = Substituter(files, path, {}, {})

    def module(self, name: str) -> bytes | None:
        """Return the source of an importable module of the tree by its dotted name."""
        found = self._files.module(name, self._path)
        return None if found is None else self._files.read(found)

    def file(self, path: Template) -> bytes | None:
        """Return the content of a file of the tree by its path as a launch file writes it."""
        text = self._substituter.text(path)
        found = self._files.find(text.text) if text.known else None
        return None if found is None else self._files.read(found)
