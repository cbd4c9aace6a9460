"""Which tree a launch file belongs to that a person names by its place on disk."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ecm_extract.tree.git_repo import find_repo

HERE = "."


def workspace_of(launches: Sequence[str]) -> str:
    """Return the tree to read where none is named: here, or around the first launch file that lies elsewhere."""
    elsewhere = (Path(text).resolve() for text in launches if Path(text).is_file() and not _is_below(text, HERE))
    return next((str(_around(path)) for path in elsewhere), HERE)


def in_workspace(text: str, workspace: str) -> str:
    """Return a launch file as the tree names it; what is no file below the workspace is left as it is."""
    if not Path(text).is_file() or not _is_below(text, workspace):
        return text
    return Path(text).resolve().relative_to(Path(workspace).resolve()).as_posix()


def _is_below(text: str, folder: str) -> bool:
    return Path(text).resolve().is_relative_to(Path(folder).resolve())


def _around(path: Path) -> Path:
    """The work tree of its repository; without one the folder of its package and of those beside it, or its own."""
    repo = find_repo(path.parent)
    if repo is not None and repo.work_tree is not None:
        return repo.work_tree
    package = next((folder for folder in path.parents if (folder / "package.xml").is_file()), None)
    if package is None:
        return path.parent
    beside = [manifest for manifest in package.parent.glob("*/package.xml") if manifest.parent != package]
    return package.parent if beside else package
