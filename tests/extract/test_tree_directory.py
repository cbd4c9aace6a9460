import os
from pathlib import Path

import pytest
from git_repos import git
from hypothesis import given, settings
from hypothesis import strategies as st
from tree_repos import make_repo, write

from ecm_extract.errors import TreeError, TreeReadError
from ecm_extract.tree import Tree, blob_id, open_tree, printable
from ecm_extract.tree.links import MAX_HOPS, resolve


def _contents(tree: Tree) -> dict[str, bytes]:
    return dict(tree.read_many(entry.path for entry in tree.files()))


def _codes(tree: Tree) -> dict[str, str]:
    return {diagnostic.path: diagnostic.code for diagnostic in tree.diagnostics}


def _both(folder: Path) -> list[Tree]:
    """The folder and its commit, which must behave alike."""
    return [open_tree(folder), open_tree(folder, "HEAD")]


def test_links(tmp_path: Path) -> None:
    """Links inside the tree are read; loops and links out of it are named and not followed."""
    (tmp_path / "secret").write_bytes(b"secret")
    repo = tmp_path / "r"
    write(repo, {"a/real.py": b"real", "b/.keep": b""})
    links = {
        "b/link.py": "../a/real.py",
        "b/chain.py": "link.py",
        "b/through.py": "../folder/real.py",
        "folder": "a",
        "self": "self",
        "x/one": "two",
        "x/two": "one",
        "out": "../secret",
        "absolute": str(tmp_path / "secret"),
        "deep": "b/../../secret",
        "gone": "a/nothing",
        "here": ".",
    }
    for path, target in links.items():
        (repo / path).parent.mkdir(exist_ok=True)
        (repo / path).symlink_to(target)
    make_repo(repo, {})
    for tree in _both(repo):
        contents = _contents(tree)
        assert {contents.pop(path) for path in ("b/link.py", "b/chain.py", "b/through.py")} == {b"real"}
        assert contents == {"a/real.py": b"real", "b/.keep": b""}
        assert _codes(tree) == {
            **dict.fromkeys(("folder", "here"), "symlink-directory"),
            **dict.fromkeys(("self", "x/one", "x/two"), "symlink-loop"),
            **dict.fromkeys(("out", "absolute", "deep"), "symlink-outside"),
            "gone": "symlink-broken",
        }
        linked = next(entry for entry in tree.files() if entry.path == "b/link.py")
        assert linked.symlink
        assert tree.identity("b/link.py") == blob_id(b"real")


@settings(max_examples=50)
@given(st.dictionaries(st.sampled_from("abcd"), st.text("abcd./", max_size=12), min_size=1), st.booleans())
def test_resolve_terminates(links: dict[str, str], has_file: bool) -> None:
    """Whatever links say, the end is a listed file or a named problem."""
    files = {"e", "d/e"} if has_file else set()
    for path in links:
        end = resolve(path, links, files, {"", "d"})
        assert (end.target in files) if end.target is not None else end.problem


def test_long_chain() -> None:
    """A chain of links longer than the bound counts as a loop."""
    links = {f"l{i}": f"l{i + 1}" for i in range(MAX_HOPS + 5)}
    assert resolve("l0", links, {f"l{MAX_HOPS + 5}"}, ()).problem == "symlink-loop"
    assert resolve("l8", links, {f"l{MAX_HOPS + 5}"}, ()).target == f"l{MAX_HOPS + 5}"


def test_file_replaced_by_link(tmp_path: Path) -> None:
    """A file that becomes a link after the listing is not followed."""
    write(tmp_path, {"t/a.py": b"a", "secret": b"s"})
    tree = open_tree(tmp_path / "t")
    tree.files()
    (tmp_path / "t/a.py").unlink()
    (tmp_path / "t/a.py").symlink_to(tmp_path / "secret")
    assert _contents(tree) == {}
    assert _codes(tree) == {"a.py": "unreadable"}


def test_large_sparse_file(tmp_path: Path) -> None:
    """A file of 50 MB is listed and not read."""
    with (tmp_path / "big.cpp").open("wb") as stream:
        stream.truncate(50 * 1024 * 1024)
    tree = open_tree(tmp_path)
    assert [entry.path for entry in tree.files()] == ["big.cpp"]
    assert _contents(tree) == {}
    assert _codes(tree) == {"big.cpp": "too-large"}


def test_special_files(tmp_path: Path) -> None:
    """A named pipe is not opened: reading it would wait for ever."""
    os.mkfifo(tmp_path / "pipe.py")
    tree = open_tree(tmp_path)
    assert tree.files() == ()
    assert _codes(tree) == {"pipe.py": "special-file"}


def test_unreadable_file_and_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What may not be read is a diagnostic each, and the rest is read."""
    write(tmp_path, {"a.py": b"a", "closed/b.py": b"b", "c.py": b"c"})
    scandir, opened = os.scandir, os.open

    def closed_scandir(folder: Path) -> object:
        if Path(folder).name == "closed":
            raise PermissionError(13, "Permission denied")
        return scandir(folder)

    def closed_open(file: Path, *args: int) -> int:
        if Path(file).name == "c.py":
            raise PermissionError(13, "Permission denied")
        return opened(file, *args)

    monkeypatch.setattr(os, "scandir", closed_scandir)
    monkeypatch.setattr(os, "open", closed_open)
    tree = open_tree(tmp_path)
    assert _contents(tree) == {"a.py": b"a"}
    assert _codes(tree) == {"closed": "unreadable", "c.py": "unreadable"}


def test_generated_folders(tmp_path: Path) -> None:
    """What build tools and package managers write is not read; a source folder of the same name is."""
    write(
        tmp_path,
        {
            "build/COLCON_IGNORE": b"",
            "build/x.py": b"",
            "install/setup.bash": b"",
            "install/.colcon_install_layout": b"",
            "log/COLCON_IGNORE": b"",
            "src/build/tool.py": b"kept",
            "src/node_modules/x.js": b"",
            "src/.hg/x": b"",
            "src/.venv/x.py": b"",
            "src/myenv/pyvenv.cfg": b"",
            "src/__pycache__/a.pyc": b"",
        },
    )
    tree = open_tree(tmp_path)
    assert _contents(tree) == {"src/build/tool.py": b"kept"}
    generated = {"build", "install", "log", "src/myenv"}
    assert _codes(tree) == dict.fromkeys(generated, "generated-folder")


def test_folder_is_sorted_and_lazy(tmp_path: Path) -> None:
    """Files are in the order of their paths, and identities are not computed before they are asked for."""
    write(tmp_path, {"b/z": b"1", "b.txt": b"2", "a": b"3"})
    entries = open_tree(tmp_path).files()
    assert [entry.path for entry in entries] == ["a", "b.txt", "b/z"]
    assert {entry.identity for entry in entries} == {None}


@pytest.mark.parametrize("path", ["../secret", "/etc/passwd", "t/../a", "", "."])
def test_read_only_listed_paths(tmp_path: Path, path: str) -> None:
    """Only a path of the listing can be read."""
    write(tmp_path, {"t/a": b"a", "secret": b"s"})
    with pytest.raises(TreeReadError):
        open_tree(tmp_path / "t").read(path)


@pytest.mark.parametrize("spec", ["nothing", "file.txt", "nothing@main", "@", "a\0b", ""])
def test_no_such_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, spec: str) -> None:
    """A spec that names no folder is an error of the input with a hint."""
    monkeypatch.chdir(tmp_path)
    write(tmp_path, {"file.txt": b""})
    with pytest.raises(TreeError) as error:
        open_tree(f"{tmp_path}/{spec}" if spec in ("nothing", "file.txt") else spec)
    assert error.value.exit_status == 2
    assert error.value.hint


def test_folder_with_at_sign(tmp_path: Path) -> None:
    """A folder whose name holds `@` is found before a ref is split off."""
    make_repo(tmp_path / "ros@home", {"a": b"1"})
    assert open_tree(tmp_path / "ros@home").label.endswith("ros@home")
    assert open_tree(f"{tmp_path}/ros@home@HEAD").label == "ros@home@HEAD"
    assert open_tree(f"{tmp_path}/ros@home@HEAD@{{0}}").label == "ros@home@HEAD@{0}"


def test_repository_without_commit(tmp_path: Path) -> None:
    """A repository before its first commit is a folder without commit."""
    git(tmp_path, "init", "-q")
    write(tmp_path, {"a": b"1"})
    tree = open_tree(tmp_path)
    assert tree.commit is None
    assert _contents(tree) == {"a": b"1"}


@settings(max_examples=50)
@given(st.binary(max_size=30))
def test_printable_is_encodable(data: bytes) -> None:
    """Any file name can be shown: no control character, no escape sequence, no surrogate."""
    shown = printable(data.decode("utf-8", "surrogateescape"))
    shown.encode("utf-8")
    assert shown.isprintable() or " " in shown or any(char.isspace() for char in shown)
    assert "\x1b" not in shown
    assert "\n" not in shown
