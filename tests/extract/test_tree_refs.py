import os
from pathlib import Path

import pytest
from git_repos import git
from tree_repos import commit, make_repo

from ecm_extract.errors import GitError, RefError
from ecm_extract.tree import merge_base, newest_release, open_repo, open_tree, release_tags, resolve_commit
from ecm_extract.tree.refs import as_release
from ecm_extract.tree.remote import public_url


@pytest.mark.parametrize(
    ("name", "version", "prerelease"),
    [
        ("1.2.10", (1, 2, 10, 0, 0, 0, 0), False),
        ("v1.2", (1, 2, 0, 0, 0, 0, 0), False),
        ("humble-1.2.3", (1, 2, 3, 0, 0, 0, 0), False),
        ("release/jazzy/nav/0.4.7-2", (0, 4, 7, 0, 0, 0, 2), False),
        ("1.2.0-rc1", (1, 2, 0, 0, 0, 0, 0), True),
        ("2.0.0b2", (2, 0, 0, 0, 0, 0, 0), True),
        ("2.0.0-alpha.1", (2, 0, 0, 0, 0, 0, 0), True),
        ("nightly", None, False),
        ("2024", None, False),
        ("1.2.3-broken-build", None, False),
        ("1." * 5000, None, False),
        ("99999999999999999999.1", None, False),
    ],
)
def test_tag_names(name: str, version: tuple[int, ...] | None, prerelease: bool) -> None:
    """A tag's name says a version, with or without prefix and packaging revision, or none at all."""
    tag = as_release(name, "c")
    assert (tag.version if tag else None) == version
    assert bool(tag and tag.prerelease) == prerelease


def _history(folder: Path) -> dict[str, str]:
    """Main with 1.9.0, 1.10.0 (annotated) and a candidate at its head; 3.0.0 on another branch."""
    ids = {"first": make_repo(folder, {"a": b"1"})}
    git(folder, "tag", "1.9.0")
    ids["second"] = commit(folder, {"a": b"2"})
    git(folder, "tag", "-a", "-m", "release", "1.10.0")
    git(folder, "checkout", "-q", "-b", "other")
    ids["other"] = commit(folder, {"a": b"x"}, "3.0.0")
    git(folder, "checkout", "-q", "main")
    ids["head"] = commit(folder, {"a": b"3"}, "1.11.0-rc1", "demo")
    return ids


def test_releases_reachable(tmp_path: Path) -> None:
    """Only reachable version tags count, in the order of versions and not of letters, with their commits."""
    ids = _history(tmp_path)
    tags = release_tags(open_repo(tmp_path), "main")
    assert [(tag.name, tag.commit) for tag in tags] == [
        ("1.9.0", ids["first"]),
        ("1.10.0", ids["second"]),
        ("1.11.0-rc1", ids["head"]),
    ]


@pytest.mark.parametrize(
    ("ref", "newest"), [("main", "1.10.0"), ("other", "1.10.0"), ("1.10.0", "1.9.0"), ("1.9.0", None)]
)
def test_newest_release(tmp_path: Path, ref: str, newest: str | None) -> None:
    """The baseline is the highest final release behind a ref, never the ref's own tag or a candidate."""
    _history(tmp_path)
    found = newest_release(open_repo(tmp_path), ref)
    assert (found.name if found else None) == newest


def test_merge_base(tmp_path: Path) -> None:
    """Two lines part at their common commit; unrelated histories have none."""
    ids = _history(tmp_path)
    git(tmp_path, "checkout", "-q", "--orphan", "island")
    commit(tmp_path, {"b": b"1"})
    repo = open_repo(tmp_path)
    assert merge_base(repo, "main", "other") == ids["second"]
    assert merge_base(repo, "main", "island") is None


@pytest.mark.parametrize("name", ["HEAD", "main", "demo", "1.11.0-rc1", "HEAD~0", "refs/heads/main", "HEAD@{0}"])
def test_resolve(tmp_path: Path, name: str) -> None:
    """Every usual way to write a commit resolves to its id, an abbreviation too."""
    ids = _history(tmp_path)
    repo = open_repo(tmp_path)
    assert resolve_commit(repo, name) == ids["head"] == resolve_commit(repo, ids["head"][:10])


@pytest.mark.parametrize(
    ("ref", "hint"),
    [
        ("1.10.1", "if it is a branch: git fetch origin 1.10.1:refs/remotes/origin/1.10.1, then give origin/1.10.1"),
        ("origin/x", "git fetch origin x:refs/remotes/origin/x"),
        ("f" * 40, "git fetch origin " + "f" * 40),
        ("$(reboot)", "Check the spelling."),
        ("--exec", "Check the spelling."),
        ("x" * 100_000, "Check the spelling."),
        ("1.9.0..1.10.0", "Give two refs as two words: 1.9.0 1.10.0"),
        ("1.9.0...1.10.0", "Give one ref; `git merge-base 1.9.0 1.10.0` tells the commit where the two part."),
        ("main..$(reboot)", "Check the spelling."),
        ("main~99", "Its history is shorter."),
    ],
)
def test_missing_ref(tmp_path: Path, ref: str, hint: str) -> None:
    """A missing ref names the nearest ones and a line that is safe to paste."""
    _history(tmp_path)
    git(tmp_path, "remote", "add", "origin", "https://example.org/r.git")
    with pytest.raises(RefError) as error:
        resolve_commit(open_repo(tmp_path), ref)
    assert error.value.hint.endswith(hint)
    assert len(error.value.message) < 400
    assert ("Nearest: 1.10.0" in error.value.hint) == (ref == "1.10.1")


def test_no_remote(tmp_path: Path) -> None:
    """A clone that was never fetched into is sent nowhere."""
    _history(tmp_path)
    with pytest.raises(RefError) as error:
        resolve_commit(open_repo(tmp_path), "zzz")
    assert "git fetch" not in error.value.hint


@pytest.mark.parametrize("ref", ["HEAD", "main", "1.0.0"])
def test_no_commit(tmp_path: Path, ref: str) -> None:
    """A repository without commits says so."""
    git(tmp_path, "init", "-q")
    with pytest.raises(RefError) as error:
        resolve_commit(open_repo(tmp_path), ref)
    assert "no branch and no tag yet" in error.value.hint


def test_orphan_head(tmp_path: Path) -> None:
    """HEAD of a new branch is no ref that could be fetched."""
    _history(tmp_path)
    git(tmp_path, "checkout", "-q", "--orphan", "new")
    with pytest.raises(RefError, match=r"HEAD of .* names a branch that has no commit yet"):
        resolve_commit(open_repo(tmp_path), "HEAD")


def test_tag_of_a_blob(tmp_path: Path) -> None:
    """A tag of something else than a commit is there, and is told to be that."""
    _history(tmp_path)
    git(tmp_path, "tag", "blobtag", git(tmp_path, "hash-object", "-w", "--stdin", stdin=b"x"))
    git(tmp_path, "tag", "-m", "annotated", "treetag", "HEAD^{tree}")
    for name, kind in (("blobtag", "blob"), ("treetag", "tree")):
        with pytest.raises(RefError, match=f"'{name}' of .* is a {kind}, not a commit"):
            resolve_commit(open_repo(tmp_path), name)


@pytest.mark.parametrize("place", ["packed-refs", "refs/heads/pipe", "shallow", "objects/info/alternates"])
def test_pipe_in_the_repository(tmp_path: Path, place: str) -> None:
    """Git would wait at a pipe for ever."""
    _history(tmp_path)
    (tmp_path / ".git" / place).unlink(missing_ok=True)
    os.mkfifo(tmp_path / ".git" / place)
    with pytest.raises(GitError, match="is a pipe"):
        resolve_commit(open_repo(tmp_path), "main")


def test_empty_objects(tmp_path: Path) -> None:
    """A damaged repository is what was given, not what the tool did."""
    ids = _history(tmp_path)
    loose = tmp_path / ".git" / "objects" / ids["head"][:2] / ids["head"][2:]
    loose.chmod(0o644)
    loose.write_bytes(b"")
    with pytest.raises(GitError) as error:
        resolve_commit(open_repo(tmp_path), "main")
    assert error.value.exit_status == 2


def test_shallow_clone(tmp_path: Path) -> None:
    """In a shallow clone the line that helps is the one that deepens it, and its history is still read."""
    _history(tmp_path / "r")
    git(tmp_path, "clone", "-q", "--depth=1", f"file://{tmp_path / 'r'}", str(tmp_path / "s"))
    repo = open_repo(tmp_path / "s")
    with pytest.raises(RefError, match="--unshallow"):
        resolve_commit(repo, "1.9.0")
    assert {tag.name for tag in release_tags(repo, "HEAD")} <= {"1.11.0-rc1"}


def test_tag_of_a_missing_object(tmp_path: Path) -> None:
    """A tag whose object is not here cannot be shown to be reachable, and does not hide the others."""
    _history(tmp_path)
    (tmp_path / ".git/refs/tags/9.9.9").write_text("1" * 40 + "\n")
    assert [tag.name for tag in release_tags(open_repo(tmp_path), "1.10.0")] == ["1.9.0", "1.10.0"]


@pytest.mark.parametrize(
    ("url", "public"),
    [
        ("https://user:token@example.org/o/r.git", "https://example.org/o/r.git"),
        ("https://token@example.org:8443/o/r?x=secret#y", "https://example.org:8443/o/r"),
        ("ssh://git@example.org/o/r", "ssh://example.org/o/r"),
        ("git@example.org:o/r.git", "ssh://example.org/o/r.git"),
        ("file:///home/me/r", None),
        ("/home/me/r", None),
        ("../r", None),
        ("C:/repos/r", None),
        ("ext::sh -c reboot", None),
        ("https://[bad", None),
        ("", None),
    ],
)
def test_public_url(url: str, public: str | None) -> None:
    """A remote is shown without user, password, token or machine path."""
    assert public_url(url) == public


def test_repository_name(tmp_path: Path) -> None:
    """The remote names the repository, and a remote on this machine gives way to the folder's name."""
    make_repo(tmp_path / "r", {"a": b""})
    git(tmp_path / "r", "remote", "add", "origin", "https://me:secret@example.org/o/r.git")
    assert open_tree(tmp_path / "r").repository == "https://example.org/o/r.git"
    git(tmp_path / "r", "remote", "set-url", "origin", str(tmp_path))
    assert open_tree(tmp_path / "r", "HEAD").repository == "r"


def test_pipe_as_configuration(tmp_path: Path) -> None:
    """What is no file says nothing."""
    ids = _history(tmp_path)
    (tmp_path / ".git" / "config").unlink()
    os.mkfifo(tmp_path / ".git" / "config")
    assert resolve_commit(open_repo(tmp_path), "main") == ids["head"]
