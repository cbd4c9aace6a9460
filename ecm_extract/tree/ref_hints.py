"""What to do about a ref that is not there: only lines that work in this clone."""

from __future__ import annotations

import difflib
import re
from collections.abc import Sequence
from typing import Final

from ecm_extract.errors import EcmError
from ecm_extract.tree.base import printable
from ecm_extract.tree.git_repo import GitRepo
from ecm_extract.tree.remote import remotes

_NEAREST: Final = 3
_MAX_CHARS: Final = 200
_OBJECT_ID: Final = re.compile(r"[0-9a-fA-F]{40}(?:[0-9a-fA-F]{24})?")
_RANGE: Final = re.compile(r"(?P<old>[^.].*?)(?P<dots>\.{2,3})(?P<new>.+)")
_NAME: Final = re.compile(r"(?!.*(?:\.\.|//|/\.|\.lock$))[\w+][\w./+-]*[\w+-]|[\w+]")
"""Names that git allows for a tag or branch and that a shell takes as they are."""


def is_shallow(repo: GitRepo) -> bool:
    """Whether the clone holds only the newest part of the history."""
    return (repo.common_dir / "shallow").exists()


def shown(ref: str) -> str:
    """A ref as a message quotes it, printable and not endless."""
    return printable(ref if len(ref) <= _MAX_CHARS else f"{ref[:_MAX_CHARS]}...")


def missing_ref_hint(repo: GitRepo, ref: str) -> str:
    """What to do about a ref that names nothing.

    Args:
        repo: that was asked.
        ref: as the user wrote it.
    """
    names = ref_names(repo)
    span = _RANGE.fullmatch(ref)
    if span is not None and _NAME.fullmatch(span["old"]) and _NAME.fullmatch(span["new"]):
        return _range_hint(span)
    if not names:
        return "The repository has no branch and no tag yet. Commit something, or give folders in place of refs."
    near = difflib.get_close_matches(ref[:_MAX_CHARS], names, _NEAREST)
    nearest = f"Nearest: {', '.join(printable(name) for name in near)}. " if near else ""
    return f"{nearest}{_fetch_hint(repo, ref)}".rstrip()


def no_release_hint(repo: GitRepo) -> str:
    """What to do where no release tag lies behind a commit."""
    if is_shallow(repo):
        return "name the old side, or get the history with `git fetch --unshallow --tags origin`"
    if remotes(repo):
        return f"name the old side, or get the tags with `git fetch --tags {remotes(repo)[0]}`"
    return "name the old side: a tag, branch, commit or folder"


def ref_names(repo: GitRepo) -> list[str]:
    """Short names of all tags and branches; empty where git cannot list them."""
    try:
        _, out = repo.run("for-each-ref", "--format=%(refname:strip=2)", "refs/tags", "refs/heads", "refs/remotes")
    except EcmError:
        return []
    return out.decode("utf-8", "surrogateescape").splitlines()


def _range_hint(span: re.Match[str]) -> str:
    old, new = shown(span["old"]), shown(span["new"])
    if span["dots"] == "..":
        return f"Give two refs as two words: {old} {new}"
    return f"Give one ref; `git merge-base {old} {new}` tells the commit where the two part."


def _fetch_hint(repo: GitRepo, ref: str) -> str:
    known = remotes(repo)
    if not known:
        return "The clone has no remote to get it from; check the spelling."
    if is_shallow(repo):
        return f"If it exists upstream: git fetch --unshallow --tags {known[0]}"
    if _OBJECT_ID.fullmatch(ref):
        return f"If it exists upstream: git fetch {known[0]} {ref}"
    is_name = len(ref) <= _MAX_CHARS and _NAME.fullmatch(ref)
    return _named_hint(known, ref) if is_name else "Check the spelling."


def _named_hint(known: Sequence[str], ref: str) -> str:
    remote, slash, branch = ref.partition("/")
    if slash and remote in known:
        return f"If it exists upstream: git fetch {remote} {branch}:refs/remotes/{ref}"
    to_tag = f"git fetch {known[0]} refs/tags/{ref}:refs/tags/{ref}"
    to_branch = f"git fetch {known[0]} {ref}:refs/remotes/{known[0]}/{ref}"
    return f"If it is a tag upstream: {to_tag}; if it is a branch: {to_branch}, then give {known[0]}/{ref}"
