"""Repositories with releases for the tests of indexing."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from git_repos import commit_all, git
from sample import driver, panel, write


def release(folder: Path, tag: str, files: Mapping[str, str]) -> None:
    """Commit files under a tag."""
    write(folder, files)
    commit_all(folder, tag)


def clone_of_three(folder: Path) -> Path:
    """Three releases and a candidate."""
    folder.mkdir()
    for version, files in (("1.0.0", driver()), ("1.1.0", panel()), ("1.2.0", driver("1.2.0", topic="status"))):
        release(folder, version, files)
    git(folder, "tag", "1.3.0-rc1")
    return folder
