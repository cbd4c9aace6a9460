import pickle
import shutil
from multiprocessing import get_context
from pathlib import Path

import pytest
from git_repos import git
from tree_repos import commit, make_repo

from ecm_extract.errors import GitError, RefError, TreeError, TreeReadError
from ecm_extract.tree import MAX_FILE_BYTES, Tree, blob_id, open_ref, open_repo, open_tree
from ecm_extract.tree import listing as listing_module

FILES = {"package.xml": b"<package/>", "src/a.cpp": b"int a;\r\n", "src/b.py": b"b = 1\n"}


def _contents(tree: Tree) -> dict[str, bytes]:
    return dict(tree.read_many(entry.path for entry in tree.files()))


def _codes(tree: Tree) -> list[tuple[str, str]]:
    return [(diagnostic.code, diagnostic.path) for diagnostic in tree.diagnostics]


def _loose(repo: Path, blob: str) -> Path:
    return repo / ".git" / "objects" / blob[:2] / blob[2:]


def test_ref_equals_folder(tmp_path: Path) -> None:
    """A ref and its checkout hold the same paths, bytes (CRLF kept) and identities."""
    head = make_repo(tmp_path / "r", FILES)
    folder, ref = open_tree(tmp_path / "r"), open_tree(f"{tmp_path / 'r'}@HEAD")
    assert _contents(folder) == _contents(ref) == FILES
    assert folder.commit == ref.commit == head
    assert folder.repository == ref.repository == "r"
    assert [e.identity for e in ref.files()] == [folder.identity(e.path) for e in folder.files()]
    assert ref.identity("src/a.cpp") == blob_id(FILES["src/a.cpp"])


def test_executable_bit(tmp_path: Path) -> None:
    """The x bit of a ref is known, for scripts without extension."""
    make_repo(tmp_path / "r", FILES)
    git(tmp_path / "r", "update-index", "--chmod=+x", "src/b.py")
    git(tmp_path / "r", "commit", "-q", "-m", "x")
    flags = {entry.path: entry.executable for entry in open_tree(tmp_path / "r", "HEAD").files()}
    assert flags == {"package.xml": False, "src/a.cpp": False, "src/b.py": True}


def test_ref_subdir(tmp_path: Path) -> None:
    """`REF:subdir` and a folder inside a work tree both open that folder at the ref."""
    make_repo(tmp_path / "r", FILES)
    for tree in (
        open_tree(tmp_path / "r", "HEAD:src"),
        open_tree(f"{tmp_path / 'r' / 'src'}@HEAD"),
        open_ref(tmp_path / "r", "HEAD:./src/"),
    ):
        assert [entry.path for entry in tree.files()] == ["a.cpp", "b.py"]


@pytest.mark.parametrize("ref", ["HEAD:nope", "HEAD:src/a.cpp", "HEAD:../x", "HEAD:/../../etc"])
def test_subdir_missing(tmp_path: Path, ref: str) -> None:
    """A folder that is not at the ref, or lies outside the repository, is an error and no empty tree."""
    make_repo(tmp_path / "r", FILES)
    with pytest.raises(RefError):
        open_ref(tmp_path / "r", ref)


@pytest.mark.parametrize(
    "ref",
    [
        "--upload-pack=touch x",
        "--help",
        "-h",
        "",
        ":",
        "a\nHEAD",
        "a\0b",
        "HEAD^{commit} x",
        "x" * 5000,
        "\udcff",
    ],
)
def test_hostile_ref(tmp_path: Path, ref: str) -> None:
    """No text in the place of a ref is taken for an option or for two refs."""
    make_repo(tmp_path / "r", FILES)
    with pytest.raises(RefError) as error:
        open_ref(tmp_path / "r", ref)
    assert error.value.exit_status == 2
    str(error.value).encode()


def test_ref_named_as_option(tmp_path: Path) -> None:
    """A ref whose real name starts with dashes is a ref."""
    head = make_repo(tmp_path / "r", FILES)
    git(tmp_path / "r", "update-ref", "refs/tags/--upload-pack=x", head)
    assert open_tree(tmp_path / "r", "--upload-pack=x").commit == head


def test_bare_without_config(tmp_path: Path) -> None:
    """A bare folder without `config` opens at HEAD and at a ref."""
    head = make_repo(tmp_path / "r", FILES)
    git(tmp_path, "clone", "-q", "--bare", str(tmp_path / "r"), str(tmp_path / "bare.git"))
    (tmp_path / "bare.git" / "config").unlink()
    assert open_tree(tmp_path / "bare.git").commit == head
    assert _contents(open_tree(f"{tmp_path / 'bare.git'}@main")) == FILES
    assert open_tree(tmp_path / "bare.git").repository == "bare"


def test_sha256_repository(tmp_path: Path) -> None:
    """A repository of the other object format opens as well."""
    git(tmp_path, "init", "-q", "--object-format=sha256", str(tmp_path / "r"))
    head = commit(tmp_path / "r", FILES)
    assert len(head) == 64
    assert _contents(open_tree(tmp_path / "r", head)) == FILES


def test_linked_work_tree(tmp_path: Path) -> None:
    """A linked work tree has its own HEAD over the shared objects."""
    make_repo(tmp_path / "r", FILES)
    git(tmp_path / "r", "worktree", "add", "-q", "--detach", str(tmp_path / "w"))
    head = commit(tmp_path / "w", {"new.txt": b"n"})
    assert open_tree(tmp_path / "w").commit == head
    assert "new.txt" in _contents(open_tree(tmp_path / "w", "HEAD"))


def test_hostile_config_runs_nothing(tmp_path: Path) -> None:
    """Programs that a repository's own configuration and hooks name are never run."""
    repo, mark = tmp_path / "r", tmp_path / "mark"
    make_repo(repo, FILES)
    program = tmp_path / "evil.sh"
    program.write_text(f"#!/bin/sh\ntouch {mark}\n")
    program.chmod(0o755)
    names = [
        "core.fsmonitor",
        "core.sshCommand",
        "core.pager",
        "diff.external",
        "core.gitProxy",
        "alias.ls-tree",
    ]
    names += ["core.alternateRefsCommand", "uploadpack.packObjectsHook", "remote.origin.uploadpack"]
    for name in names:
        git(repo, "config", name, f"!{program}" if name.startswith("alias") else str(program))
    git(repo, "config", "remote.origin.url", f"ext::{program}")
    git(repo, "config", "remote.origin.promisor", "true")
    git(repo, "config", "protocol.ext.allow", "always")
    git(repo, "config", "extensions.partialClone", "origin")
    (repo / ".git" / "hooks").mkdir()
    shutil.copy(program, repo / ".git" / "hooks" / "post-checkout")
    _loose(repo, blob_id(FILES["src/b.py"])).unlink()
    tree = open_tree(repo, "HEAD")
    assert set(_contents(tree)) == {"package.xml", "src/a.cpp"}
    assert _codes(tree) == [("missing-blob", "src/b.py")]
    assert open_tree(repo).repository == "r"
    assert not mark.exists()
    git(repo, "status")
    assert mark.exists(), "the trap must work, or this test shows nothing"


def test_machine_environment_is_ignored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Git variables of the caller (a hook, a wrapper) do not redirect what is read."""
    head = make_repo(tmp_path / "r", FILES)
    for name in ("GIT_DIR", "GIT_OBJECT_DIRECTORY", "GIT_INDEX_FILE", "GIT_WORK_TREE"):
        monkeypatch.setenv(name, "/nowhere")
    assert open_tree(tmp_path / "r", "HEAD").commit == head


def test_missing_blob(tmp_path: Path) -> None:
    """A missing blob is one diagnostic that says how to get it; the rest is read."""
    make_repo(tmp_path / "r", FILES)
    _loose(tmp_path / "r", blob_id(FILES["src/a.cpp"])).unlink()
    tree = open_tree(tmp_path / "r", "HEAD")
    assert set(_contents(tree)) == {"package.xml", "src/b.py"}
    assert _codes(tree) == [("missing-blob", "src/a.cpp")]
    assert "git fetch" in tree.diagnostics[0].message
    with pytest.raises(TreeReadError) as error:
        tree.read("src/a.cpp")
    assert error.value.code == "missing-blob"


def test_damaged_blob(tmp_path: Path) -> None:
    """A damaged object costs itself and not the files after it."""
    make_repo(tmp_path / "r", FILES)
    loose = _loose(tmp_path / "r", blob_id(FILES["package.xml"]))
    data = loose.read_bytes()
    loose.chmod(0o644)
    loose.write_bytes(data[:-6] + b"\xff" * 6)
    tree = open_tree(tmp_path / "r", "HEAD")
    assert set(_contents(tree)) == {"src/a.cpp", "src/b.py"}
    assert _codes(tree) == [("missing-blob", "package.xml")]


def test_missing_folder_object(tmp_path: Path) -> None:
    """A tree whose folder objects are missing is an error, not a shorter tree."""
    make_repo(tmp_path / "r", FILES)
    _loose(tmp_path / "r", git(tmp_path / "r", "rev-parse", "HEAD:src")).unlink()
    with pytest.raises(TreeError, match="lacks"):
        open_tree(tmp_path / "r", "HEAD").files()


def test_submodule(tmp_path: Path) -> None:
    """A submodule is named with its commit and not read."""
    head = make_repo(tmp_path / "r", FILES)
    git(tmp_path / "r", "update-index", "--add", "--cacheinfo", f"160000,{head},deps/sub")
    git(tmp_path / "r", "commit", "-q", "-m", "sub")
    tree = open_tree(tmp_path / "r", "HEAD")
    assert [entry.path for entry in tree.files()] == sorted(FILES)
    assert _codes(tree) == [("submodule", "deps/sub")]
    assert tree.diagnostics[0].severity == "info"


def test_large_blob(tmp_path: Path) -> None:
    """A blob above the bound is listed and not read."""
    make_repo(tmp_path / "r", {"big.cpp": b"/" * (MAX_FILE_BYTES + 1), "a.cpp": b"a"})
    tree = open_tree(tmp_path / "r", "HEAD")
    assert _contents(tree) == {"a.cpp": b"a"}
    assert _codes(tree) == [("too-large", "big.cpp")]


def test_too_many_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A tree of unbounded size ends in an error (a few git objects can describe billions of files)."""
    monkeypatch.setattr("ecm_extract.tree.git_ref.MAX_FILES", 2)
    monkeypatch.setattr("ecm_extract.tree.directory.MAX_FILES", 2)
    assert listing_module.MAX_FILES > 2
    make_repo(tmp_path / "r", FILES)
    for tree in (open_tree(tmp_path / "r"), open_tree(tmp_path / "r", "HEAD")):
        with pytest.raises(TreeError, match="more than"):
            tree.files()


def test_tree_bomb(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Fifteen objects that describe 10^15 files end in an error as soon as the bound is passed."""
    monkeypatch.setattr("ecm_extract.tree.git_ref.MAX_FILES", 5000)
    git(tmp_path, "init", "-q")
    below = f"100644 blob {git(tmp_path, 'hash-object', '-w', '--stdin', stdin=b'x')}"
    for _ in range(15):
        rows = "".join(f"{below}\t{name}\n" for name in "abcdefghij")
        below = f"040000 tree {git(tmp_path, 'mktree', stdin=rows.encode())}"
    head = git(tmp_path, "commit-tree", "-m", "bomb", below.split()[2])
    with pytest.raises(TreeError, match="more than"):
        open_tree(tmp_path, head).files()


def test_odd_names(tmp_path: Path) -> None:
    """Names with a line break, a tab, quotes or bytes that are no UTF-8 are read and shown safely."""
    names = ["a\nb.py", "t\tab.py", '"q".py', b"\xff.py".decode("utf-8", "surrogateescape"), "-n.py"]
    make_repo(tmp_path / "r", {name: name.encode("utf-8", "surrogateescape") for name in names})
    for tree in (open_tree(tmp_path / "r"), open_tree(tmp_path / "r", "HEAD")):
        assert set(_contents(tree)) == set(names)
        list(tree.read_many(["no\n\udcff"]))
        assert _codes(tree) == [("not-in-tree", r"no\n\xff")]


def test_stop_early_leaves_no_process(tmp_path: Path) -> None:
    """Who stops reading in the middle of many files is not left waiting."""
    make_repo(tmp_path / "r", {f"f{i}.cpp": bytes([i]) * 100_000 for i in range(60)})
    tree = open_tree(tmp_path / "r", "HEAD")
    reader = tree.read_many([entry.path for entry in tree.files()] * 40)
    assert next(iter(reader))[0] == "f0.cpp"
    reader.close()  # type: ignore[attr-defined]


def _first(tree: Tree) -> bytes:
    return tree.read("src/a.cpp")


def test_trees_travel_to_workers(tmp_path: Path) -> None:
    """A tree is pickled and forked, and the worker reads by itself."""
    make_repo(tmp_path / "r", FILES)
    for tree in (open_tree(tmp_path / "r"), open_tree(tmp_path / "r", "HEAD")):
        assert _contents(pickle.loads(pickle.dumps(tree))) == FILES
        tree.files()
        with get_context("fork").Pool(1) as pool:
            assert pool.apply(_first, (tree,)) == FILES["src/a.cpp"]


def test_repository_is_not_written(tmp_path: Path) -> None:
    """Reading leaves every file of the repository as it was."""
    make_repo(tmp_path / "r", FILES)
    before = {path: path.stat().st_mtime_ns for path in (tmp_path / "r").rglob("*")}
    _contents(open_tree(tmp_path / "r", "HEAD"))
    assert {path: path.stat().st_mtime_ns for path in (tmp_path / "r").rglob("*")} == before


def test_no_repository(tmp_path: Path) -> None:
    """A ref of a plain folder is an error that says what to give instead."""
    with pytest.raises(TreeError, match="not in a git repository"):
        open_ref(tmp_path, "main")


def test_git_not_installed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without git a ref cannot be read, which the user can mend (status 2), and a folder is read all the same."""
    make_repo(tmp_path / "r", FILES)
    monkeypatch.setenv("PATH", str(tmp_path))
    assert _contents(open_tree(tmp_path / "r")) == FILES
    with pytest.raises(GitError) as error:
        open_repo(tmp_path / "r").run("cat-file", "--batch-check")
    assert error.value.exit_status == 2
