"""Small git repositories for the tests of trees, built by git itself in a folder of the test."""

from pathlib import Path

from git_repos import commit_all, git


def write(folder: Path, files: dict[str, bytes]) -> None:
    """Write files, their folders too."""
    for path, data in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_bytes(data)


def make_repo(folder: Path, files: dict[str, bytes]) -> str:
    """A repository with one commit of these files; returns its id."""
    folder.mkdir(parents=True, exist_ok=True)
    return commit(folder, files)


def commit(folder: Path, files: dict[str, bytes], *tags: str) -> str:
    """Commit these files on top and tag the commit; returns its id."""
    write(folder, files)
    commit_all(folder, *tags)
    return git(folder, "rev-parse", "HEAD")
