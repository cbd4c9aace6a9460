"""Submodules of a repository: which there are, where their objects lie on this machine, what is said without them."""

from __future__ import annotations

import configparser
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath

from ecm_extract.errors import EcmError
from ecm_extract.tree.base import FileDiagnostic, printable
from ecm_extract.tree.git_repo import GitRepo, repo_at
from ecm_extract.tree.unread import Unread

FILE_NAME = ".gitmodules"
_GITLINK = "160000"


def submodule_names(data: bytes) -> Mapping[str, str]:
    """Name of each submodule by its path, of the bytes of a `.gitmodules`; empty when it is none."""
    text = "\n".join(line.strip() for line in data.decode("utf-8", "surrogateescape").splitlines())
    parser = configparser.RawConfigParser(strict=False, allow_no_value=True, default_section="")
    try:
        parser.read_string(text)
    except configparser.Error:
        return {}
    rows = {section: parser.get(section, "path", fallback=None) for section in parser.sections()}
    return {path: section.partition(" ")[2].strip('"') for section, path in rows.items() if path}


def submodules_at(repo: GitRepo, commit: str) -> Mapping[str, str]:
    """Commit of each submodule that a commit names, by its path; empty where git cannot list it."""
    try:
        _, out = repo.run("ls-tree", "-r", "-z", "--full-tree", commit)
    except EcmError:
        return {}
    records = (record.partition("\t") for record in out.decode("utf-8", "surrogateescape").split("\0"))
    return {path: head.split(" ")[2] for head, _, path in records if head.startswith(_GITLINK)}


def submodule_repo(repo: GitRepo, path: str, name: str | None) -> GitRepo | None:
    """The repository of a submodule, where its objects are inside those of the superproject or in its work tree.

    Args:
        repo: of the superproject.
        path: of the submodule, from the root of the superproject.
        name: of the submodule, which its folder in `.git/modules` is called by.
    """
    work_tree = repo.work_tree / path if repo.work_tree is not None else None
    found = (repo_at(place, work_tree) for place in _places(repo, name, work_tree) if _is_within(repo, place))
    return next((each for each in found if each is not None and _is_within(repo, each.git_dir)), None)


def _places(repo: GitRepo, name: str | None, work_tree: Path | None) -> Iterator[Path]:
    if name and not PurePosixPath(name).is_absolute():
        yield from (folder / "modules" / name for folder in (repo.git_dir, repo.common_dir))
    if work_tree is not None:
        yield work_tree / ".git"


def _is_within(repo: GitRepo, place: Path) -> bool:
    """A name with `..`, a link or a pointer must not lead into somebody else's repository."""
    roots = [folder.resolve() for folder in (repo.common_dir, repo.work_tree) if folder is not None]
    return any(place.resolve().is_relative_to(root) for root in roots)


def submodule_unread(path: str, commit: str) -> FileDiagnostic:
    """What is said of a submodule whose files are not here."""
    shown = printable(path)
    message = f"The submodule at {commit[:12]} is not in this clone. Get it with `git submodule update --init {shown}`."
    return FileDiagnostic("info", "submodule", shown, 0, message, Unread(shown, "submodule", commit=commit))
