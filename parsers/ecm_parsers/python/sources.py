"""What else of the tree a Python file reads while it is read: whoever has the tree hands it in."""

from __future__ import annotations

from typing import Protocol

from ecm_parsers.template import Template


class Sources(Protocol):
    """Gives bytes of other files; None for what the tree does not hold. Paths may depend on launch arguments."""

    def declared(self, name: str, default: Template) -> None:
        """Take note of an argument of a launch file, for paths that depend on it."""

    def module(self, name: str) -> bytes | None:
        """Return the source of an importable module by its dotted name."""

    def file(self, path: Template) -> bytes | None:
        """Return the content of a file by its path as the file that reads it writes it."""

    def exists(self, path: Template) -> bool | None:
        """Return whether the tree holds a file, None when the path does not tell."""

    def names(self, folder: Template) -> tuple[str, ...] | None:
        """Return the names of the files of a folder, None when the path does not tell."""


class NoSources:
    """A file that is read alone."""

    def declared(self, name: str, default: Template) -> None:
        """Do nothing."""

    def module(self, name: str) -> bytes | None:
        """Return None."""
        return None

    def file(self, path: Template) -> bytes | None:
        """Return None."""
        return None

    def exists(self, path: Template) -> bool | None:
        """Return None."""
        return None

    def names(self, folder: Template) -> tuple[str, ...] | None:
        """Return None."""
        return None
