"""Files of ours that lie in somebody's workspace: answers and baselines."""

from __future__ import annotations

from pathlib import Path

from ecm_extract.errors import InputError
from ecm_extract.tree.git_repo import find_repo


def own_file(folder: Path, name: str) -> Path:
    """The place of a file of ours in a workspace, whether it is there or not.

    A repository could have brought a link: through it a file elsewhere would be read, or written.

    Args:
        folder: of the workspace.
        name: of the file.

    Raises:
        InputError: the place is taken by a link that leads out of the repository, or by no regular file.
    """
    place = folder / name
    if place.is_symlink() and not _is_inside(place.resolve(), folder):
        message = f"{place} is a symbolic link that leads out of the repository"
        raise InputError(message, "put a file there in its place")
    if place.exists() and not place.is_file():
        message = f"{place} is no regular file"
        raise InputError(message, "put a file there in its place")
    return place


def _is_inside(target: Path, folder: Path) -> bool:
    """Inside the work tree, and not among what belongs to git."""
    repo = find_repo(folder)
    root = repo.work_tree if repo is not None and repo.work_tree is not None else folder.resolve()
    return target.is_relative_to(root) and ".git" not in target.relative_to(root).parts
