"""Folders of a tree that another repository fills."""

from __future__ import annotations

from ecm_extract.lint.workspace import Workspace


def submodules(workspace: Workspace) -> frozenset[str]:
    """Return the paths of the submodules that `.gitmodules` names."""
    text = (workspace.files.read(".gitmodules") or b"").decode("utf-8", "replace")
    return frozenset(line.partition("=")[2].strip() for line in text.splitlines() if line.strip().startswith("path"))
