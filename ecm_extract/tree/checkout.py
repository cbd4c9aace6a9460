"""What git tracks and a folder lacks all the same, because only a part of the repository was fetched or checked out."""

from __future__ import annotations

from ecm_extract.errors import GitError, RefError, TreeError
from ecm_extract.tree.base import Tree
from ecm_extract.tree.git_repo import GitRepo, find_repo
from ecm_extract.tree.open import open_ref


def left_out(tree: Tree) -> frozenset[str]:
    """Return the files of HEAD that a folder lacks without anybody having deleted them; none of other trees.

    These are files whose content was not fetched (partial clones), and all of a sparse checkout.
    """
    repo = find_repo(tree.checkout) if tree.checkout is not None else None
    if repo is None or tree.checkout is None:
        return frozenset()
    try:
        tracked = open_ref(tree.checkout, "HEAD").files()
    except (GitError, RefError, TreeError):
        return frozenset()
    there = {entry.path for entry in tree.files()}
    sparse = _is_sparse(repo)
    return frozenset(entry.path for entry in tracked if (sparse or entry.size is None) and entry.path not in there)


def _is_sparse(repo: GitRepo) -> bool:
    return (repo.git_dir / "info" / "sparse-checkout").is_file()
