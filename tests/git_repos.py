"""Git repositories of tests, made by git itself, apart from the configuration of the machine and at a fixed date."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path
from typing import Final

_SETTINGS: Final = {
    "user.name": "Test",
    "user.email": "test@example.org",
    "init.defaultBranch": "main",
    "init.templateDir": "",
    "commit.gpgsign": "false",
    "core.autocrlf": "false",
    "maintenance.auto": "false",
    "protocol.file.allow": "always",
}
_DATE: Final = "2020-01-01T00:00:00Z"


def git(folder: Path, *args: str, stdin: bytes = b"") -> str:
    """Run git in a folder and return what it writes."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    fixed = {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1", "HOME": str(folder)}
    dates = {"GIT_AUTHOR_DATE": _DATE, "GIT_COMMITTER_DATE": _DATE}
    settings = [word for key, value in _SETTINGS.items() for word in ("-c", f"{key}={value}")]
    command = ["git", *settings, *args]
    done = subprocess.run(command, cwd=folder, env=kept | fixed | dates, input=stdin, capture_output=True, check=True)
    return done.stdout.decode().strip()


def commit_all(folder: Path, *tags: str) -> None:
    """Commit what lies in a folder, a repository from now on, and tag the commit."""
    if not (folder / ".git").exists():
        _begin(folder / ".git")
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "--allow-empty", "-m", " ".join(("release", *tags)))
    for tag in tags:
        _tag(folder, tag)


def _begin(own: Path) -> None:
    """What `git init` writes: a process takes as long as many a test."""
    for name in ("objects/info", "objects/pack", "refs/heads", "refs/tags"):
        (own / name).mkdir(parents=True)
    (own / "HEAD").write_text("ref: refs/heads/main\n")
    (own / "config").write_text("[core]\n\trepositoryformatversion = 0\n\tfilemode = true\n\tbare = false\n")


def _tag(folder: Path, name: str) -> None:
    """What `git tag` writes, where HEAD is a branch of a plain repository."""
    head = folder / ".git/HEAD"
    branch = folder / ".git" / head.read_text().removeprefix("ref: ").strip() if head.is_file() else head
    if branch.is_file():
        place = folder / ".git/refs/tags" / name
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(branch.read_bytes())
    else:
        git(folder, "tag", name)
