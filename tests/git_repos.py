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
        git(folder, "init", "-q")
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "--allow-empty", "-m", " ".join(("release", *tags)))
    for tag in tags:
        git(folder, "tag", tag)
