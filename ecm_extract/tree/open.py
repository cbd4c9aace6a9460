"""From what a person types to a tree: a folder, `DIR@REF`, a git folder, or `REF:subdir` of a repository."""

from pathlib import Path, PurePosixPath

from ecm_extract.errors import RefError, TreeError
from ecm_extract.tree.base import Tree, printable
from ecm_extract.tree.directory import DirectoryTree
from ecm_extract.tree.git_ref import GitTree
from ecm_extract.tree.git_repo import GitRepo, find_repo
from ecm_extract.tree.refs import head_commit, resolve_commit, resolve_tree
from ecm_extract.tree.remote import repository_name


def open_tree(spec: str | Path, ref: str | None = None) -> Tree:
    """Open a folder, or a ref of the repository around it.

    Args:
        spec: a folder, `DIR@REF`, `DIR@REF:subdir`, or a git folder (then its HEAD).
        ref: `REF` or `REF:subdir`; `spec` is then only a folder.

    Raises:
        TreeError: there is no such folder or repository; RefError: no such ref or folder at that ref.
    """
    text = str(spec)
    folder, wanted = (Path(text), ref) if ref is not None else _split(text)
    if wanted is not None:
        return open_ref(folder, wanted)
    repo = find_repo(folder)
    if repo is not None and repo.work_tree is None:
        return open_ref(folder, "HEAD")
    return DirectoryTree(
        folder.resolve(),
        label=printable(text),
        commit=head_commit(repo) if repo else None,
        repository=repository_name(repo) if repo else None,
    )


def open_ref(folder: Path, ref: str) -> Tree:
    """Open `REF` or `REF:subdir` of the repository that `folder` is or lies in.

    A folder inside a work tree stands for the same folder at that ref; `subdir` starts there.

    Raises:
        TreeError: `folder` is not in a repository; RefError: no such ref, or no such folder at that ref.
    """
    repo = open_repo(folder)
    name, _, subdir = ref.partition(":")
    commit = resolve_commit(repo, name)
    place = _inside(repo, folder, subdir)
    return GitTree(
        repo,
        resolve_tree(repo, commit, place),
        label=printable(f"{repo.name}@{ref}"),
        commit=commit,
        repository=repository_name(repo),
    )


def open_repo(folder: Path) -> GitRepo:
    """The repository that `folder` is or lies in.

    Raises:
        TreeError: there is none.
    """
    repo = find_repo(folder) if folder.is_dir() else None
    if repo is None:
        message = f"{printable(str(folder))} is not in a git repository."
        raise TreeError(message, "Give a clone of the repository; a ref cannot be read from a plain folder.")
    return repo


def _split(text: str) -> tuple[Path, str | None]:
    """Folder and ref of a spec; the longest folder that exists wins, for both parts may hold `@`."""
    at = len(text)
    while at > 0:
        folder = Path(text[:at])
        if folder.is_dir():
            return folder, text[at + 1 :] if at < len(text) else None
        at = text.rfind("@", 0, at)
    is_file = Path(text).is_file()
    message = f"{printable(text)} is a file, not a folder." if is_file else f"There is no folder {printable(text)}."
    raise TreeError(message, "Give the folder of a package or workspace, or DIR@REF.")


def _inside(repo: GitRepo, folder: Path, subdir: str) -> str:
    """Path from the root of the repository to `subdir` of `folder`."""
    start = folder.resolve().relative_to(repo.work_tree) if repo.work_tree else PurePosixPath()
    parts = [*start.parts, *(part for part in subdir.split("/") if part not in ("", "."))]
    if ".." in parts:
        message = f"The folder {printable(subdir)!r} leads out of the repository."
        raise RefError(message, "Write it from the root of the repository, without `..`.")
    return "/".join(parts)
