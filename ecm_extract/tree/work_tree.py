"""Whether the files of a work tree are those of its commit."""

from __future__ import annotations

from ecm_extract.errors import EcmError
from ecm_extract.tree.git_repo import GitRepo


def has_uncommitted(repo: GitRepo) -> bool:
    """Tell whether files of the work tree differ from HEAD or are new; False where git cannot tell.

    Submodules are not looked into: git would read their configuration.
    """
    if repo.work_tree is None:
        return False
    asked = ("status", "--porcelain", "--ignore-submodules=all")
    try:
        _, out = repo.run("-c", "core.bare=false", "--work-tree", str(repo.work_tree), *asked)
    except EcmError:
        return False
    return bool(out.strip())
