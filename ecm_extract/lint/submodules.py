"""Folders of a tree that another repository fills."""

from __future__ import annotations

from ecm_extract.lint.workspace import Workspace
from ecm_extract.tree.submodules import FILE_NAME, submodule_names


def submodules(workspace: Workspace) -> frozenset[str]:
    """Return the paths of the submodules that `.gitmodules` names."""
    return frozenset(submodule_names(workspace.files.read(FILE_NAME) or b""))
