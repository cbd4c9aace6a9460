"""Files that moved between two trees: what git detects, else files of the same content."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping
from pathlib import Path

from ecm_extract.entities.side import Side
from ecm_extract.errors import EcmError
from ecm_extract.tree.git_repo import GitRepo, find_repo

_SIMILARITY = "-M50%"
_LIMIT = "-l2000"
_SOURCES = ("*.[ch]", "*.[ch]pp", "*.[ch]xx", "*.cc", "*.hh", "*.py", "*.msg", "*.srv", "*.action", "*.cfg", "*.xml")
_OTHERS = ("*.yaml", "*.yml", "*.launch", "*.xacro", "*.urdf", "*.srdf", "*.txt")
"""Only files that can declare something: pictures and meshes cost time, and partial clones do not hold them."""


def renamed_files(old: Side, new: Side, repo_folder: Path | None) -> Mapping[str, str]:
    """Return the new path of each file that moved, by its old path.

    Content that a partial clone does not hold cannot be compared; then only files of the same blob are found.
    """
    found = _same_blobs(old, new)
    repo = find_repo(repo_folder) if repo_folder is not None else None
    if repo is not None and old.commit and new.commit and old.blobs and new.blobs:
        found = {**_by_git(repo, old.commit, new.commit), **found}
    return found


def _by_git(repo: GitRepo, old: str, new: str) -> dict[str, str]:
    options = ("-r", "-z", _SIMILARITY, _LIMIT, "--diff-filter=R", "--name-status")
    try:
        _, out = repo.run("diff-tree", *options, old, new, "--", *_SOURCES, *_OTHERS)
    except EcmError:
        return {}
    fields = out.decode("utf-8", "surrogateescape").split("\0")
    return {fields[index + 1]: fields[index + 2] for index in range(0, len(fields) - 2, 3)}


def _same_blobs(old: Side, new: Side) -> dict[str, str]:
    added: dict[str, list[str]] = defaultdict(list)
    for path, blob in new.blobs.items():
        if path not in old.blobs:
            added[blob].append(path)
    return {
        path: added[blob][0]
        for path, blob in old.blobs.items()
        if path not in new.blobs and len(added.get(blob, ())) == 1
    }
