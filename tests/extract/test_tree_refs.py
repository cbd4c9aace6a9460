from pathlib import Path

import pytest
from tree_repos import commit, git, make_repo

from ecm_extract.errors import RefError
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
        ("1.10.1", "git fetch origin refs/tags/1.10.1:refs/tags/1.10.1"),
        ("f" * 40, "git fetch origin " + "f" * 40),
        ("$(reboot)", "git fetch --tags origin"),
        ("--exec", "git fetch --tags origin"),
    ],
)
def test_missing_ref(tmp_path: Path, ref: str, hint: str) -> None:
    """A missing ref names the nearest ones and a line that is safe to paste."""
    _history(tmp_path)
    with pytest.raises(RefError) as error:
        resolve_commit(open_repo(tmp_path), ref)
    assert error.value.hint.endswith(hint)
    assert ("1.10.0" in error.value.hint) == (ref == "1.10.1")


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
