"""Repositories with releases for the tests of indexing."""

from __future__ import annotations

import subprocess
from collections.abc import Mapping
from pathlib import Path

from sample import driver, panel, write


def git(folder: Path, *words: str) -> None:
    """Run git as nobody in particular."""
    identity = ["-c", "user.name=t", "-c", "user.email=t@example.org", "-c", "commit.gpgsign=false"]
    subprocess.run(["git", *identity, *words], cwd=folder, check=True, capture_output=True)


def release(folder: Path, tag: str, files: Mapping[str, str]) -> None:
    """Commit files under a tag."""
    write(folder, files)
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "-m", tag)
    git(folder, "tag", tag)


def clone_of_three(folder: Path) -> Path:
    """Three releases and a candidate."""
    folder.mkdir()
    git(folder, "init", "-q", "-b", "main")
    for version, files in (("1.0.0", driver()), ("1.1.0", panel()), ("1.2.0", driver("1.2.0", topic="status"))):
        release(folder, version, files)
    git(folder, "tag", "1.3.0-rc1")
    return folder
