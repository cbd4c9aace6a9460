"""From what a person types to a tree: a folder, `DIR@REF`, a git folder, or `REF:subdir` of a repository."""

from collections.abc import Mapping
from pathlib import Path, PurePosixPath

from ecm_extract.errors import RefError, TreeError
from ecm_extract.tree.base import Tree, printable
from ecm_extract.tree.directory import DirectoryTree
from ecm_extract.tree.git_ref import GitTree
from ecm_extract.tree.git_repo import GitRepo, find_repo
from ecm_extract.tree.ref_hints import shown
from ecm_extract.tree.refs import head_commit, resolve_tree
from ecm_extract.tree.remote import repository_name
from ecm_extract.tree.submodules import FILE_NAME, submodules_at
from ecm_extract.tree.superproject import SuperprojectTree


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
    commit = head_commit(repo) if repo else None
    return DirectoryTree(
        folder.resolve(),
        label=printable(text),
        commit=commit,
        repository=repository_name(repo) if repo else None,
        submodules=_submodules_below(repo, folder, commit) if repo and commit else {},
    )


def open_ref(folder: Path, ref: str) -> Tree:
    """Open `REF` or `REF:subdir` of the repository that `folder` is or lies in.

    A folder inside a work tree stands for the same folder at that ref; `subdir` starts there.

    Raises:
        TreeError: `folder` is not in a repository; RefError: no such ref, or no such folder at that ref.
    """
    repo = open_repo(folder)
    name, _, subdir = ref.partition(":")
    place = _inside(repo, folder, subdir)
    commit, tree_id = resolve_tree(repo, name, place)
    tree = GitTree(
        repo,
        tree_id,
        label=printable(f"{repo.name}@{ref}"),
        commit=commit,
        repository=repository_name(repo),
    )
    return SuperprojectTree(tree, repo, place)


def open_repo(folder: Path) -> GitRepo:
    """The repository that `folder` is or lies in.

    Raises:
        TreeError: there is none.
    """
    if not is_folder(folder):
        raise no_folder(str(folder))
    repo = find_repo(folder)
    if repo is None:
        message = f"{printable(str(folder))} is not in a git repository."
        raise TreeError(message, "Give a clone of the repository; a ref cannot be read from a plain folder.")
    return repo


def _submodules_below(repo: GitRepo, folder: Path, commit: str) -> Mapping[str, str]:
    """Commit of each submodule of HEAD below a folder of the work tree, by its path in the folder."""
    if repo.work_tree is None or not (repo.work_tree / FILE_NAME).is_file():
        return {}
    start = "".join(f"{part}/" for part in folder.resolve().relative_to(repo.work_tree).parts)
    found = submodules_at(repo, commit).items()
    return {path.removeprefix(start): each for path, each in found if path.startswith(start)}


def _split(text: str) -> tuple[Path, str | None]:
    """Folder and ref of a spec; the longest folder that exists wins, for both parts may hold `@`."""
    at = len(text)
    while at > 0:
        folder = Path(text[:at])
        if is_folder(folder):
            return folder, text[at + 1 :] if at < len(text) else None
        at = text.rfind("@", 0, at)
    raise no_folder(text)


def no_folder(text: str) -> TreeError:
    """The error for a folder that is not there."""
    message = f"{shown(text)} is a file, not a folder." if _is_file(text) else f"There is no folder {shown(text)}."
    return TreeError(message, "Give the folder of a package or workspace, or DIR@REF.")


def is_folder(path: str | Path) -> bool:
    """Whether there is such a folder; a name that no file system takes is none."""
    try:
        return Path(path).is_dir()
    except (OSError, ValueError):
        return False


def _is_file(text: str) -> bool:
    try:
        return Path(text).is_file()
    except (OSError, ValueError):
        return False


def _inside(repo: GitRepo, folder: Path, subdir: str) -> str:
    """Path from the root of the repository to `subdir` of `folder`."""
    start = folder.resolve().relative_to(repo.work_tree) if repo.work_tree else PurePosixPath()
    parts = [*start.parts, *(part for part in subdir.split("/") if part not in ("", "."))]
    if ".." in parts:
        message = f"The folder {printable(subdir)!r} leads out of the repository."
        raise RefError(message, "Write it from the root of the repository, without `..`.")
    return "/".join(parts)
