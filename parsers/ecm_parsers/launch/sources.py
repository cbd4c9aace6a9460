"""What else of the tree a Python launch file reads while it is read: whoever has the tree hands it in."""

from __future__ import annotations

from typing import Protocol

from ecm_parsers.launch.model import Template


class Sources(Protocol):
    """Gives bytes of other files; None for what the tree does not hold."""

    def module(self, name: str) -> bytes | None:
        """Return the source of an importable module by its dotted name."""

    def file(self, path: Template) -> bytes | None:
        """Return the content of a file by its path as the launch file writes it."""


class NoSources:
    """A launch file that is read alone."""

    def module(self, name: str) -> bytes | None:
        """Return None."""
        return None

    def file(self, path: Template) -> bytes | None:
        """Return None."""
        return None
