"""Refs as people use them: which commit a name means, which releases lie behind it, where two lines part."""

import re
from collections.abc import Sequence

import msgspec

from ecm_extract.errors import GitError, RefError, TreeError
from ecm_extract.tree.base import printable
from ecm_extract.tree.git_batch import describe_objects
from ecm_extract.tree.git_repo import GitRepo
from ecm_extract.tree.ref_hints import is_shallow, missing_ref_hint, ref_names, shown

_MAX_REF_CHARS = 1024
_VERSION = re.compile(
    r"(?:^|[-_/vV])(?P<numbers>\d{1,9}(?:\.\d{1,9}){1,5})(?:-(?P<revision>\d{1,9}))?"
    r"(?P<pre>[-_.+~]?(?:a|b|c|rc|alpha|beta|pre|preview|dev|snapshot|test|nightly)[-_.]?\d{0,9})?$",
    re.IGNORECASE,
)


class ReleaseTag(msgspec.Struct, frozen=True):
    """A tag that names a version, e.g. `1.2.0`, `v1.2.0`, `humble-1.2.0`, `1.2.0-rc1`.

    Attributes:
        name: of the tag, without `refs/tags/`.
        commit: id of the tagged commit.
        version: its numbers, then the number after a dash (a packaging revision), else 0.
        prerelease: whether it is a release candidate or the like.
    """

    name: str
    commit: str
    version: tuple[int, ...]
    prerelease: bool


def resolve_commit(repo: GitRepo, ref: str) -> str:
    """Commit id that `ref` means: tag, branch, commit, `HEAD~2`.

    Raises:
        RefError: there is none; the hint names the nearest refs and the line that fetches it.
    """
    return _resolve_commits(repo, [ref])[0]


def resolve_tree(repo: GitRepo, ref: str, subdir: str) -> tuple[str, str]:
    """Ids of the commit that `ref` means and of the folder `subdir` (`''` for the root) there, out of one process.

    Raises:
        RefError: there is no such ref, or no such folder at its commit.
    """
    names = [f"{ref}^{{commit}}", f"{ref}^{{commit}}:{subdir}"]
    commit, tree = describe_objects(repo, names) if all(map(_is_sane, names)) else (None, None)
    if tree is None or tree[1] != "tree" or commit is None:
        shown_commit = resolve_commit(repo, ref)[:12]
        message = f"{repo.name} has no folder {printable(subdir)!r} at {shown_commit}."
        raise RefError(message, "Check the path; it may have another name at that ref.")
    return commit[0], tree[0]


def head_commit(repo: GitRepo) -> str | None:
    """Commit id of HEAD; None when the repository has no commit yet or cannot be read."""
    try:
        found = _describe(repo, "HEAD^{commit}")
    except (GitError, TreeError):
        return None
    return found[0] if found else None


def merge_base(repo: GitRepo, one: str, other: str) -> str | None:
    """Commit id of the best common ancestor of two refs; None when they have none.

    Raises:
        RefError: one of the refs does not exist.
    """
    status, out = repo.run("merge-base", *_resolve_commits(repo, [one, other]), accept=(0, 1))
    return out.decode("ascii").split()[0] if status == 0 else None


def release_tags(repo: GitRepo, ref: str | None = None) -> tuple[ReleaseTag, ...]:
    """Tags that name a version and are reachable from `ref`, or all of them; lowest version first.

    Raises:
        RefError: the ref does not exist.
        GitError: the history is damaged.
    """
    merged = [f"--merged={resolve_commit(repo, ref)}"] if ref is not None else []
    layout = "--format=%(refname:strip=2)%00%(objectname)%00%(*objectname)"
    _, out = repo.run("for-each-ref", *merged, layout, "refs/tags")
    rows = (line.split("\0") for line in out.decode("utf-8", "surrogateescape").splitlines())
    tags = [tag for name, direct, peeled in rows if (tag := as_release(name, peeled or direct))]
    return tuple(sorted(tags, key=lambda tag: (tag.version, not tag.prerelease, tag.name)))


def newest_release(repo: GitRepo, ref: str) -> ReleaseTag | None:
    """The highest release reachable from `ref` other than `ref` itself; None when there is none.

    Release candidates do not count. A release is compared with the one before it, so a tag on the
    commit of `ref` is passed over, and so is any version above the one that `ref` itself is tagged with.

    Raises:
        RefError: the ref does not exist.
    """
    commit = resolve_commit(repo, ref)
    final = [tag for tag in release_tags(repo, commit) if not tag.prerelease]
    own = [tag.version for tag in final if tag.commit == commit]
    before = [tag for tag in final if tag.commit != commit and (not own or tag.version < max(own))]
    return before[-1] if before else None


def as_release(name: str, commit: str) -> ReleaseTag | None:
    """The release that a tag's name says; None when it says no version."""
    match = _VERSION.search(name)
    if match is None:
        return None
    numbers = [int(number) for number in match["numbers"].split(".")]
    padded = numbers + [0] * (6 - len(numbers))
    return ReleaseTag(name, commit, (*padded, int(match["revision"] or 0)), bool(match["pre"]))


def _resolve_commits(repo: GitRepo, refs: Sequence[str]) -> list[str]:
    """Commit ids of refs out of one process; the first that is none is told."""
    names = [f"{ref}^{{commit}}" for ref in refs if _is_sane(ref)]
    found = dict(zip(names, describe_objects(repo, names) if names else (), strict=True))
    commits = [(ref, found.get(f"{ref}^{{commit}}")) for ref in refs]
    for ref, commit in commits:
        if commit is None:
            raise _no_commit(repo, ref)
    return [commit[0] for _, commit in commits if commit is not None]


def _describe(repo: GitRepo, name: str) -> tuple[str, str] | None:
    found = describe_objects(repo, [name])
    return found[0] if found else None


def _no_commit(repo: GitRepo, ref: str) -> RefError:
    """The error for a ref that is none, or that is one of something else than a commit."""
    other = _describe(repo, f"{ref}^{{}}") if _is_sane(ref) else None
    if other is not None:
        message = f"{shown(ref)!r} of {repo.name} is a {other[1]}, not a commit."
        return RefError(message, "Give a tag of a commit, a branch or a commit.")
    if re.fullmatch(r"(?:HEAD|@)", ref) and ref_names(repo):
        message = f"HEAD of {repo.name} names a branch that has no commit yet."
        return RefError(message, "Give a branch or tag that is there, or check one out.")
    start = re.match(r"[^~^]*", ref)
    if start is not None and start[0] not in ("", ref) and _is_sane(ref) and _describe(repo, f"{start[0]}^{{commit}}"):
        message = f"{repo.name} has {shown(start[0])!r}, but nothing at {shown(ref)!r}."
        return RefError(message, _no_ancestor_hint(repo))
    return RefError(f"{repo.name} has no ref or commit {shown(ref)!r}.", missing_ref_hint(repo, ref))


def _no_ancestor_hint(repo: GitRepo) -> str:
    return "Get the history with `git fetch --unshallow origin`." if is_shallow(repo) else "Its history is shorter."


def _is_sane(ref: str) -> bool:
    return 0 < len(ref) <= _MAX_REF_CHARS and min(ref) >= " "
