"""Names that stand in the sources of a package and that no endpoint of a node beside them explains.

A helper that is not understood may use such a name, and a helper that several nodes share is not known to be theirs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import PurePosixPath
from typing import Final

from ecm_extract.lint.source_text import texts_in
from ecm_extract.lint.workspace import Workspace

_NAME: Final = re.compile(r"(?:~/?|/)?([A-Za-z][\w/]*)", re.ASCII)
_RUNS: Final = frozenset({"node", "nodelet", "component"})
"""Kinds of modules that run by themselves; others are handed the node that they declare their names with."""
CALL_LINES: Final = 3
"""A name stands up to so many lines below the call that it belongs to."""


class WrittenNames:
    """Texts of packages that look like names, each package read when it is asked for."""

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self._found: dict[str, frozenset[str]] = {}
        self._ports = frozenset(_given_to_ports(workspace))
        self._explained = {
            (place.path, place.line + below, _bare(interface.raw_name))
            for entry in workspace.linked
            for interface in entry.interfaces
            for place in interface.evidence
            if entry.module.kind in _RUNS and PurePosixPath(place.path).stem == PurePosixPath(entry.module.path).stem
            if not interface.row.value or not _remaps_parameters(workspace, entry.module.package)
            for below in range(CALL_LINES + 1)
        }

    def holds(self, package: str, name: str) -> bool:
        """Tell whether a package writes a name, with or without `~`, where nothing that is known is declared.

        What a behaviour tree gives to a port may reach any node that runs the tree.
        """
        if _bare(name) in self._ports:
            return True
        if package not in self._found:
            self._found[package] = frozenset(self._unexplained(package))
        return _bare(name) in self._found[package]

    def anywhere(self, name: str) -> bool:
        """Tell whether any package of the workspace does."""
        return any(self.holds(package.name, name) for package in self._workspace.packages)

    def _unexplained(self, package: str) -> Iterator[str]:
        facts = self._workspace.by_name.get(package)
        for path, source in facts.sources.items() if facts is not None else ():
            for text in texts_in(self._workspace.files.read(path) or b"", source.language):
                found = _NAME.fullmatch(text.value)
                if found is not None and (path, text.line, found[1]) not in self._explained:
                    yield found[1]


def _given_to_ports(workspace: Workspace) -> Iterator[str]:
    files = (file for package in workspace.packages for file in package.trees.values())
    values = (value for file in files for tree in file.trees for node in tree.nodes for value in node.ports.values())
    yield from (_bare(value) for value in values if _NAME.fullmatch(value))


def _remaps_parameters(workspace: Workspace, package: str) -> bool:
    """Tell whether a remap reaches the names of parameters too, as it does in ROS 1."""
    facts = workspace.by_name.get(package)
    return facts is not None and facts.ros == 1


def _bare(name: str) -> str:
    return name.lstrip("~/")
