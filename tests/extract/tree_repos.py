"""Small git repositories for the tests of trees, built by git itself in a folder of the test."""

import os
import subprocess
from pathlib import Path

_IDENTITY = ("-c", "user.name=Test", "-c", "user.email=test@example.org", "-c", "init.defaultBranch=main")
_QUIET = ("-c", "protocol.file.allow=always", "-c", "commit.gpgsign=false", "-c", "core.autocrlf=false")


def git(folder: Path, *args: str, stdin: bytes = b"") -> str:
    """Run git in a folder, apart from the configuration of the machine."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    env = kept | {"GIT_CONFIG_GLOBAL": os.devnull, "GIT_CONFIG_NOSYSTEM": "1", "HOME": str(folder)}
    command = ["git", *_IDENTITY, *_QUIET, *args]
    done = subprocess.run(command, cwd=folder, env=env, input=stdin, capture_output=True, check=True)
    return done.stdout.decode().strip()


def write(folder: Path, files: dict[str, bytes]) -> None:
    """Write files, their folders too."""
    for path, data in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(data)


def make_repo(folder: Path, files: dict[str, bytes]) -> str:
    """A repository with one commit of these files; returns its id."""
    folder.mkdir(parents=True, exist_ok=True)
    git(folder, "init", "-q")
    return commit(folder, files)


def commit(folder: Path, files: dict[str, bytes], *tags: str) -> str:
    """Commit these files on top and tag the commit; returns its id."""
    write(folder, files)
    git(folder, "add", "-A")
    git(folder, "commit", "-q", "--allow-empty", "-m", "change")
    for tag in tags:
        git(folder, "tag", tag)
    return git(folder, "rev-parse", "HEAD")
