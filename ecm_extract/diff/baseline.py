"""Which two trees are compared, and why the old one was chosen."""

from __future__ import annotations

from pathlib import Path

from ecm_extract.diff.model import RefInfo
from ecm_extract.errors import RefError, TreeError
from ecm_extract.stored import Stored, is_stored, read_stored
from ecm_extract.tree import (
    Tree,
    is_shallow,
    merge_base,
    newest_release,
    open_ref,
    open_tree,
    release_tags,
    resolve_commit,
)
from ecm_extract.tree.git_repo import GitRepo, find_repo
from ecm_extract.tree.open import is_folder, no_folder, open_repo
from ecm_extract.tree.ref_hints import no_release_hint

WORK_TREE = "."
_PATHS = ("./", "../", "/", "~/")
"""How a path begins that cannot be taken for a ref."""


def open_side(spec: str, repo: Path) -> Tree | Stored:
    """Open what `open_source` opens, or stored documents: a file, or a folder that holds them instead of packages.

    Raises:
        TreeError: it is none of these.
        InputError: a document cannot be read.
    """
    return read_stored(spec) if spec != WORK_TREE and is_stored(spec) else open_source(spec, repo)


def open_source(spec: str, repo: Path) -> Tree:
    """Open a folder, `DIR@REF`, or a ref of the repository; `.` is its work tree, or HEAD of a bare one.

    A bare word is a ref first, and a folder where none is called so.

    Raises:
        TreeError: neither a folder nor a ref.
    """
    if spec == WORK_TREE:
        return open_tree(repo)
    if _is_folder(spec):
        return open_tree(spec)
    if spec.startswith(_PATHS):
        raise no_folder(spec)
    try:
        return open_ref(repo, spec)
    except TreeError:
        if is_folder(spec):
            return open_tree(spec)
        raise


def _is_folder(spec: str) -> bool:
    head = spec.split("@", 1)[0]
    return "/" in spec and (is_folder(spec) or (bool(head) and is_folder(head)))


def open_consumer(spec: str) -> Tree | Stored:
    """Open what uses the two sides: a folder, `DIR@REF`, or documents.

    Raises:
        TreeError: it is none of these.
        InputError: a document cannot be read.
    """
    return read_stored(spec) if is_stored(spec) else open_tree(spec)


def default_baseline(new: str, repo: Path) -> tuple[str, str]:
    """Return the newest release that is reachable from the new side, and why it was chosen.

    Raises:
        RefError: there is no release tag behind the new side.
    """
    git = open_repo(repo)
    at = "HEAD" if new == WORK_TREE else new
    tag = newest_release(git, at.partition(":")[0])
    if tag is None:
        raise _no_baseline(git, at)
    return tag.name, f"newest release tag reachable from {at}"


def _no_baseline(repo: GitRepo, at: str) -> RefError:
    own = [tag.name for tag in release_tags(repo, at.partition(":")[0]) if not tag.prerelease]
    if own:
        message = f"no release tag lies before {at}, which is the release {own[-1]} itself"
        return RefError(message, "name the old side; of a first release there is none")
    return RefError(f"no release tag is reachable from {at}", no_release_hint(repo))


def open_base(spec: str, repo: Path, now: Tree, tip: bool) -> tuple[Tree, RefInfo]:
    """Open what a change started from: the last commit that REF and the change have in common.

    What was added to REF since is nothing that the change took away.

    Args:
        spec: as for `open_source`; only a ref has a commit in common.
        repo: folder of the repository.
        now: the tree with the change.
        tip: take REF as it is.

    Raises:
        TreeError: neither a folder nor a ref; RefError: there is no such commit in this clone.
    """
    ref, colon, subdir = spec.partition(":")
    given = None if tip or now.commit is None or _is_folder(spec) else _commit_of(ref, repo)
    if given is None:
        tree = open_source(spec, repo)
        return tree, RefInfo(spec, tree.commit, "as it is" if tip else "named")
    shared = merge_base(open_repo(repo), given, now.commit or given)
    if shared is None:
        raise _nothing_shared(ref, given, now, open_repo(repo))
    tree = open_source(f"{shared}{colon}{subdir}", repo)
    return tree, RefInfo(spec, shared, f"merge base of {ref} {given[:12]} and of this at {(now.commit or '')[:12]}")


def _commit_of(ref: str, repo: Path) -> str | None:
    try:
        return resolve_commit(open_repo(repo), ref)
    except TreeError:
        return None


def _nothing_shared(ref: str, given: str, now: Tree, git: GitRepo) -> RefError:
    message = f"{ref} {given[:12]} and this at {(now.commit or '')[:12]} have no commit in common"
    cut = f"{message} in this clone, which is shallow" if is_shallow(git) else message
    get = "get the history with `git fetch --unshallow origin`, or " if is_shallow(git) else ""
    return RefError(cut, f"{get}compare with {ref} as it is: --base-tip")


def parting(old: Tree | Stored, new: Tree | Stored, repo: Path) -> str | None:
    """Commit where two sides part; None where the old one lies behind the new one, or they share no repository."""
    git = find_repo(repo)
    if git is None or old.commit is None or new.commit is None:
        return None
    if isinstance(old, Stored) or isinstance(new, Stored) or old.repository != new.repository:
        return None
    shared = merge_base(git, old.commit, new.commit)
    return shared if shared != old.commit else None
