"""Submodules: read at the commit that the superproject names where their objects are here, else told."""

import shutil
from pathlib import Path

import pytest
from git_repos import git
from tree_repos import commit, make_repo, write

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.tree import Tree, Unread, open_tree, unread_of
from ecm_extract.tree.submodules import submodule_names


@pytest.fixture
def inner(tmp_path: Path) -> list[str]:
    """The commits of a repository that is going to be a submodule."""
    first = make_repo(tmp_path / "inner", {"lib/package.xml": b"<a/>", "lib/a.msg": b"int8 a\n"})
    return [first, commit(tmp_path / "inner", {"lib/a.msg": b"int8 b\n"})]


@pytest.fixture
def outer(tmp_path: Path, inner: list[str]) -> Path:
    """A superproject whose tags 1.0.0 and 1.1.0 name the two commits."""
    folder = tmp_path / "outer"
    make_repo(folder, {"own/package.xml": b"<b/>"})
    git(folder, "submodule", "--quiet", "add", "--name", "some lib", f"file://{tmp_path / 'inner'}", "deps/inner")
    for name, tag in zip(inner, ("1.0.0", "1.1.0"), strict=True):
        git(folder / "deps" / "inner", "checkout", "-q", name)
        commit(folder, {}, tag)
    return folder


def contents(tree: Tree) -> dict[str, bytes]:
    return {path: data for path, data in tree.read_many(e.path for e in tree.files()) if not path.startswith(".")}


def test_each_ref_has_its_own_commit(outer: Path) -> None:
    """The files stand in the folder of the submodule, as they were at the commit that the ref names."""
    assert contents(open_tree(outer, "1.0.0")) == {
        "deps/inner/lib/a.msg": b"int8 a\n",
        "deps/inner/lib/package.xml": b"<a/>",
        "own/package.xml": b"<b/>",
    }
    tree = open_tree(outer, "1.1.0")
    assert tree.read("deps/inner/lib/a.msg") == b"int8 b\n"
    assert unread_of(tree.diagnostics) == ()


def test_objects_in_the_folder_of_the_submodule(outer: Path) -> None:
    """Old clones keep the repository of a submodule in its own folder."""
    place = outer / "deps" / "inner" / ".git"
    place.unlink()
    shutil.move(outer / ".git" / "modules" / "some lib", place)
    config = place / "config"
    config.write_text(config.read_text().replace("worktree", "; worktree"))
    assert open_tree(outer, "1.0.0").read("deps/inner/lib/a.msg") == b"int8 a\n"


def test_folder_at_a_ref(outer: Path) -> None:
    """`REF:subdir` starts at the folder, its submodules too."""
    assert set(contents(open_tree(outer, "1.0.0:deps"))) == {"inner/lib/a.msg", "inner/lib/package.xml"}


def test_submodule_of_a_submodule(tmp_path: Path, outer: Path) -> None:
    """Submodules have submodules."""
    git(tmp_path, "init", "-q", "top")
    git(tmp_path / "top", "submodule", "--quiet", "add", f"file://{outer}", "outer")
    git(tmp_path / "top", "submodule", "--quiet", "update", "--init", "--recursive")
    commit(tmp_path / "top", {}, "1.0.0")
    assert open_tree(tmp_path / "top", "1.0.0").read("outer/deps/inner/lib/a.msg") == b"int8 b\n"


def test_clone_without_submodules(tmp_path: Path, outer: Path, inner: list[str]) -> None:
    """What is not here is told with its commit, of a ref and of the work tree."""
    git(tmp_path, "clone", "-q", str(outer), "clone")
    for tree, name in ((open_tree(tmp_path / "clone", "1.0.0"), inner[0]), (open_tree(tmp_path / "clone"), inner[1])):
        assert set(contents(tree)) == {"own/package.xml"}
        assert unread_of(tree.diagnostics) == (Unread("deps/inner", "submodule", commit=name),)


def test_commit_that_was_not_fetched(outer: Path) -> None:
    """The repository of the submodule may be older than the superproject."""
    git(outer, "update-index", "--cacheinfo", f"160000,{'1' * 40},deps/inner")
    git(outer, "commit", "-q", "-m", "ahead")
    tree = open_tree(outer, "HEAD")
    assert set(contents(tree)) == {"own/package.xml"}
    assert [each.commit for each in unread_of(tree.diagnostics)] == ["1" * 40]


@pytest.mark.parametrize("name", ["../../../inner/.git", "/inner", "x/../../../../inner/.git"])
def test_name_that_leads_out(tmp_path: Path, inner: list[str], name: str) -> None:
    """No name in `.gitmodules` opens a repository that is not inside the superproject."""
    folder = tmp_path / "hostile"
    named = name.replace("/inner", f"{tmp_path}/inner/.git", 1) if name.startswith("/") else name
    make_repo(folder, {".gitmodules": f'[submodule "{named}"]\n\tpath = sub\n\turl = x\n'.encode()})
    git(folder, "update-index", "--add", "--cacheinfo", f"160000,{inner[0]},sub")
    git(folder, "commit", "-q", "-m", "link")
    tree = open_tree(folder, "HEAD")
    assert [entry.path for entry in tree.files()] == [".gitmodules"]


def test_pointer_that_leads_out(tmp_path: Path, inner: list[str]) -> None:
    """Neither does a `.git` file in the folder of the submodule."""
    folder = tmp_path / "hostile"
    make_repo(folder, {"a": b""})
    git(folder, "update-index", "--add", "--cacheinfo", f"160000,{inner[0]},sub")
    git(folder, "commit", "-q", "-m", "link")
    write(folder, {"sub/.git": f"gitdir: {tmp_path}/inner/.git\n".encode()})
    assert [entry.path for entry in open_tree(folder, "HEAD").files()] == ["a"]


@pytest.mark.parametrize(
    ("text", "names"),
    [
        (b'[submodule "a b"]\n\tpath = x/y\n\turl = u\n[submodule "c"]\npath=z\n', {"x/y": "a b", "z": "c"}),
        (b'[core]\n\tbare\n[submodule "n"]\n\turl = u\n', {}),
        (b"path = x\n", {}),
        (b"\xff\x00[[[", {}),
        (b"", {}),
    ],
)
def test_gitmodules(text: bytes, names: dict[str, str]) -> None:
    """The name of each submodule by its path, whatever else stands in the file."""
    assert submodule_names(text) == names


def test_a_condition_on_a_submodule_that_is_not_here(tmp_path: Path, inner: list[str]) -> None:
    """A node that is built where the submodule is checked out is told without it too."""
    cmake = b"project(p)\nif(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/inner/lib)\nadd_executable(n n.cpp)\nendif()\n"
    manifest = b'<package format="3"><name>p</name><version>1.0.0</version></package>'
    node = b'class N : public rclcpp::Node { N() : Node("n") { create_publisher<std_msgs::msg::Bool>("a", 1); } };'
    main = b"int main() { rclcpp::spin(std::make_shared<N>()); }"
    make_repo(tmp_path / "outer", {"CMakeLists.txt": cmake, "package.xml": manifest, "n.cpp": node + main})
    git(tmp_path / "outer", "submodule", "--quiet", "add", f"file://{tmp_path / 'inner'}", "inner")
    commit(tmp_path / "outer", {})
    git(tmp_path / "outer", "submodule", "--quiet", "deinit", "--force", "inner")
    extraction = extract(open_tree(tmp_path / "outer"), Options(jobs=1))
    modules = [module.ecm.module_id for package in extraction.packages for module in package.modules]
    assert modules == ["ecm.p.n"]
