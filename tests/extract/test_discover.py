from pathlib import Path

import pytest
from tree_repos import make_repo, write

from ecm_extract.discover import discover
from ecm_extract.read.facts import PackageFacts
from ecm_extract.test_code import is_test_path
from ecm_extract.tree import Tree, open_tree


def _tree(folder: Path, *paths: str) -> Tree:
    write(folder, dict.fromkeys(paths, b""))
    return open_tree(folder)


def _packages(tree: Tree) -> dict[str, list[str]]:
    return {root.path: [entry.path for entry in root.files] for root in discover(tree)}


def _codes(tree: Tree) -> list[str]:
    return [diagnostic.code for diagnostic in tree.diagnostics]


def test_packages_and_their_files(tmp_path: Path) -> None:
    """A file belongs to its innermost package; a file outside any belongs to none."""
    tree = _tree(tmp_path, "README.md", "a/package.xml", "a/src/x.cpp", "a/in/package.xml", "a/in/y.py", "ab/z")
    assert _packages(tree) == {
        "a": ["a/package.xml", "a/src/x.cpp"],
        "a/in": ["a/in/package.xml", "a/in/y.py"],
    }
    assert _codes(tree) == []


def test_package_at_the_root(tmp_path: Path) -> None:
    """The tree itself may be the package."""
    tree = _tree(tmp_path, "package.xml", "src/x.cpp")
    assert _packages(tree) == {"": ["package.xml", "src/x.cpp"]}
    assert discover(tree)[0].manifest == "package.xml"


@pytest.mark.parametrize("marker", ["COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE"])
def test_ignored_folders(tmp_path: Path, marker: str) -> None:
    """A marked folder is left out with all below it, and said once with its size."""
    tree = _tree(tmp_path, "a/package.xml", f"b/{marker}", "b/package.xml", f"b/c/{marker}", "b/c/package.xml")
    assert _packages(tree) == {"a": ["a/package.xml"]}
    discover(tree)
    assert [(d.severity, d.code, d.path) for d in tree.diagnostics] == [("info", "ignored-folder", "b")]
    assert "its 4 file(s)" in tree.diagnostics[0].message


@pytest.mark.parametrize("marker", ["COLCON_IGNORE", "CATKIN_IGNORE", "AMENT_IGNORE"])
def test_marker_inside_of_a_package(tmp_path: Path, marker: str) -> None:
    """A marker hides packages: files of the package that it lies in stay, of which nothing is said as left out."""
    tree = _tree(tmp_path, "a/package.xml", f"a/b/{marker}", "a/b/x.py", "a/b/in/package.xml", f"a/c/{marker}")
    assert _packages(tree) == {"a": [f"a/b/{marker}", "a/b/x.py", f"a/c/{marker}", "a/package.xml"]}
    discover(tree)
    assert [d.path for d in tree.diagnostics] == ["a/b"]
    assert "its 1 file(s)" in tree.diagnostics[0].message


def test_marker_in_the_given_folder(tmp_path: Path) -> None:
    """A marker in the folder that the user named does not hide it."""
    tree = _tree(tmp_path, "COLCON_IGNORE", "package.xml")
    assert _packages(tree) == {"": ["COLCON_IGNORE", "package.xml"]}


def test_no_package(tmp_path: Path) -> None:
    """A tree without manifest is one pseudo package, and a diagnostic says so."""
    tree = _tree(tmp_path, "src/x.cpp")
    assert _packages(tree) == {"": ["src/x.cpp"]}
    assert discover(tree)[0].manifest is None
    assert _codes(tree) == ["no-package"]


def test_rosbuild(tmp_path: Path) -> None:
    """`manifest.xml` makes a package of ROS Fuerte's time, unless a package.xml is beside or above it."""
    tree = _tree(
        tmp_path,
        "stack.xml",
        "old/manifest.xml",
        "both/manifest.xml",
        "both/package.xml",
        "both/data/manifest.xml",
    )
    found = {root.path: (root.manifest, root.rosbuild) for root in discover(tree)}
    assert found == {"both": ("both/package.xml", False), "old": ("old/manifest.xml", True)}


@pytest.mark.parametrize(
    ("path", "root", "expected"),
    [
        ("p/test/a.cpp", "p", True),
        ("p/src/tests/a.py", "p", True),
        ("p/src/pose_test.cpp", "p", True),
        ("p/src/test_pose.py", "p", True),
        ("p/conftest.py", "p", True),
        ("p/launch/drive.test", "p", True),
        ("conftest.py", "", True),
        ("test/p/src/a.cpp", "test/p", False),
        ("p/src/contest.py", "p", False),
        ("p/src/latest.cpp", "p", False),
        ("p/src/testing.cpp", "p", False),
        ("p/msg/SelfTest.msg", "p", False),
        ("p/srv/self_test.srv", "p", False),
        ("p/test_data/a.cpp", "p", False),
    ],
)
def test_test_paths(path: str, root: str, expected: bool) -> None:
    """Test code is told by its path below the package root; an interface is never a test by its name."""
    assert is_test_path(path, root) is expected


NAMELESS = b"<package><version>1.0.0</version></package>"


def _names(tree: Tree) -> list[str]:
    return [PackageFacts(root).name for root in discover(tree)]


@pytest.mark.parametrize("manifest", ["package.xml", "manifest.xml"])
def test_without_a_name_a_package_is_called_as_its_folder(manifest: str, tmp_path: Path) -> None:
    """However it is reached: in a tree, alone, or at a ref."""
    repo = tmp_path / "robot"
    make_repo(repo, {f"arm/{manifest}": NAMELESS})
    reached = [open_tree(repo), open_tree(repo / "arm"), open_tree(repo, "HEAD:arm"), open_tree(repo / "arm", "HEAD")]
    assert [_names(tree) for tree in reached] == [["arm"]] * 4


def test_a_tree_without_manifests_is_no_folder_of_a_package(tmp_path: Path) -> None:
    """Its folder is called as anybody likes."""
    assert _names(_tree(tmp_path / "arm", "a.cpp")) == ["package"]
