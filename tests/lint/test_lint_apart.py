"""What lint says of a package is the same with its neighbours as sources and as documents, whichever rule says it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import NamedTuple

import msgspec
import pytest
from ecm_checker.finding import Finding
from ecm_checker.hub.package import Package
from lint_fixtures import FIXTURES

from ecm_extract.extraction import extract
from ecm_extract.extraction_model import Options
from ecm_extract.lint.catalogue import catalogue
from ecm_extract.lint.run import findings_of
from ecm_extract.lint.workspace import Workspace
from ecm_extract.stored import package_of
from ecm_extract.tree import open_tree

OF_ONE_TREE = {entry.rule.id for entry in catalogue() if entry.rule.of_one_tree}
ROBOTS = [FIXTURES.parent / name for name in ("arm_robot", "demo_robot")]
TREES = sorted(
    tree
    for tree in (*FIXTURES.glob("*/*"), *(FIXTURES.parent / "rules").glob("*/*"), *ROBOTS)
    if len(list(tree.rglob("package.xml"))) > 1
)
MARK = re.compile(r"document:[^/]+/")


def stored(folder: Path) -> list[Package]:
    """The packages of a folder as documents of a commit hold them, on a disk."""
    tree = open_tree(folder)
    found = [package_of(each) for each in extract(tree, Options(jobs=1, hub=True)).packages]
    of_ref = (msgspec.structs.replace(each, files={path: tree.identity(path) for path in each.files}) for each in found)
    return [msgspec.json.decode(msgspec.json.encode(each), type=Package) for each in of_ref]


def told(findings: list[Finding], folder: str) -> list[str]:
    """Findings whose first line is in a folder, whole, with the paths in it from there."""
    found = (each for each in findings if each.rule not in OF_ONE_TREE and each.evidence)
    below = (each for each in found if each.evidence[0].path.startswith(folder))
    return sorted(MARK.sub("", msgspec.json.encode(each).decode()).replace(folder, "") for each in below)


def alone(tree: Path, folder: str, documents: list[Package]) -> list[Finding]:
    return findings_of(Workspace(open_tree(tree / folder), Options(jobs=1), stored=documents))


class Sides(NamedTuple):
    """What is found by folder of a package: alone, with the others as documents, and in the tree, which `whole` is."""

    alone: dict[str, list[str]]
    together: dict[str, list[str]]
    whole: Workspace


def sides(tree: Path) -> Sides:
    whole = Workspace(open_tree(tree), Options(jobs=1))
    folders = [f"{package.root.path}/" for package in whole.packages if package.root.path]
    if len(folders) < 2:
        return Sides({}, {}, whole)
    documents, found = stored(tree), findings_of(whole)
    single = {folder: told(alone(tree, folder, documents), "") for folder in folders}
    return Sides(
        {folder: [each.replace(folder, "") for each in single[folder]] for folder in folders},
        {folder: told(found, folder) for folder in folders},
        whole,
    )


@pytest.mark.parametrize("tree", TREES, ids=lambda each: f"{each.parent.name}/{each.name}")
def test_every_package_of_every_fixture(tree: Path, apart: Path) -> None:
    """All rules."""
    found = sides(apart / tree.relative_to(FIXTURES) if tree.is_relative_to(FIXTURES) else tree)
    assert found.alone == found.together


MANIFEST = """<package format="2"><name>{0}</name><version>1.0.0</version>
<buildtool_depend>catkin</buildtool_depend>{1}</package>"""
BUILD = """cmake_minimum_required(VERSION 3.5)
project({0})
find_package(catkin REQUIRED)
catkin_package()
install(DIRECTORY launch urdf DESTINATION share/{0})
"""
PLAIN = {"plain/package.xml": MANIFEST.format("plain", ""), "plain/CMakeLists.txt": BUILD.format("plain")}
ROBOT = {
    "arm/package.xml": MANIFEST.format("arm", "<depend>xacro</depend><depend>arm_tools_of_ours</depend>"),
    "arm/CMakeLists.txt": BUILD.format("arm"),
    "arm/launch/a.launch": "<launch>\n  <param name='urdf' command='$(find xacro)/xacro.py a'/>\n</launch>\n",
}
LIBRARY = {
    "core/package.xml": MANIFEST.format("core", "<depend>rospy</depend>"),
    "core/CMakeLists.txt": BUILD.format("core"),
    "core/setup.py": "from setuptools import setup\nsetup(packages=['core'], package_dir={'': 'src'})\n",
    "core/src/core/__init__.py": "",
    "core/src/core/server.py": "import rospy\n\n\nclass Server:\n    def __init__(self):\n"
    "        self.level = rospy.get_param('/server/level', 1)\n",
    "user/package.xml": MANIFEST.format("user", "<depend>rospy</depend><depend>core</depend>"),
    "user/CMakeLists.txt": BUILD.format("user"),
    "user/scripts/run.py": "#!/usr/bin/env python\nimport rospy\nfrom core.server import Server\n"
    "if __name__ == '__main__':\n    rospy.init_node('run')\n    Server()\n    rospy.spin()\n",
}
TALKS = """#!/usr/bin/env python
import rospy
from std_msgs.msg import {1}
rospy.init_node('{0}')
end = rospy.{2}('/level', {1}, {3})
rospy.spin()
"""
NAMELESS = {
    "arm/manifest.xml": "<package><description>Of an arm.</description></package>\n",
    "arm/launch/a.launch": "<launch>\n  <include file='$(find arm)/launch/gone.launch'/>\n</launch>\n",
    "hand/package.xml": "<package><version>1.0.0</version></package>\n",
    "hand/launch/b.launch": "<launch>\n  <include file='$(find arm)/launch/a.launch'/>\n</launch>\n",
}
BUILT_ONLY = "cmake_minimum_required(VERSION 3.5)\nproject({0})\nfind_package(catkin REQUIRED)\ncatkin_package()\n"
OF_DEVEL = {
    path.format(name): text
    for name in ("first", "second")
    for path, text in {
        "{0}/package.xml": MANIFEST.format(name, ""),
        "{0}/CMakeLists.txt": BUILT_ONLY.format(name) + f"add_executable({name} src/a.cpp)\n",
        "{0}/src/a.cpp": "int main() { return 0; }\n",
    }.items()
}
OLD = """from typing_extensions import deprecated


class Map:
    @deprecated('Use drop.')
    def delete_map(self):
        pass
"""
MARKED = LIBRARY | {
    "core/src/core/server.py": OLD,
    "core/scripts/tool.py": "from core.server import Map\nMap().delete_map()\n",
    "user/scripts/run.py": "from core.server import Map\nMap().delete_map()\n",
    "user/scripts/other.py": "class Mine:\n    def delete_all(self):\n        pass\n",
}
HIDDEN = MARKED | {"user/scripts/other.py": "class Mine:\n    def delete_map(self):\n        pass\n"}
TWICE = {path: text.replace("/server/level", "/server/server/level") for path, text in LIBRARY.items()}
DEPENDS = "<depend>rospy</depend><depend>std_msgs</depend>"
STARTED = {
    "driver/package.xml": MANIFEST.format("driver", DEPENDS),
    "driver/CMakeLists.txt": BUILD.format("driver"),
    "driver/scripts/driver.py": TALKS.format("driver", "Int32", "Publisher", "queue_size=1"),
    "panel/package.xml": MANIFEST.format("panel", DEPENDS),
    "panel/CMakeLists.txt": BUILD.format("panel"),
    "panel/scripts/panel.py": TALKS.format("panel", "String", "Subscriber", "print"),
    "bringup/package.xml": MANIFEST.format("bringup", "<depend>driver</depend><depend>panel</depend>"),
    "bringup/CMakeLists.txt": BUILD.format("bringup"),
    "bringup/launch/all.launch": "<launch>\n  <node pkg='driver' type='driver.py' name='driver'/>\n"
    "  <node pkg='panel' type='panel.py' name='panel'/>\n</launch>\n",
}
XACRO = '<robot {0}xmlns:xacro="http://www.ros.org/wiki/xacro">\n  {1}\n</robot>\n'
DESCRIBED = {
    "parts/package.xml": MANIFEST.format("parts", "<depend>xacro</depend>"),
    "parts/CMakeLists.txt": BUILD.format("parts"),
    "parts/urdf/hand.xacro": XACRO.format("", "<xacro:finger/>"),
    "whole/package.xml": MANIFEST.format("whole", "<depend>xacro</depend><depend>parts</depend>"),
    "whole/CMakeLists.txt": BUILD.format("whole"),
    "whole/urdf/robot.urdf.xacro": XACRO.format(
        'name="robot" ', '<link name="base"/>\n  <xacro:include filename="$(find parts)/urdf/hand.xacro"/>'
    ),
}
NOTHING_OF = {
    "core/package.xml": MANIFEST.format("core", ""),
    "core/CMakeLists.txt": BUILD.format("core"),
    "core/include/shapes/box.hpp": "class Box {};\n",
    "other/package.xml": MANIFEST.format("other", ""),
    "other/CMakeLists.txt": BUILD.format("other"),
    "user/package.xml": MANIFEST.format("user", "<build_depend>core</build_depend><build_depend>other</build_depend>"),
    "user/CMakeLists.txt": BUILD.format("user"),
    "user/src/a.cpp": "#include <shapes/box.hpp>\n",
}
LATCHED = """import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node('{0}')
end = node.create_{1}(String, '/map_name', {2})
rclpy.spin(node)
"""
KEEPS = "QoSProfile(depth=1, durability=DurabilityPolicy.{0})"
OF_ROS2 = """<package format="3"><name>{0}</name><version>1.0.0</version><depend>rclpy</depend><depend>std_msgs</depend>
<export><build_type>ament_python</build_type></export></package>"""
LATE = {
    path.format(name): text
    for name, source in (
        ("keeper", LATCHED.format("keeper", "publisher", KEEPS.format("TRANSIENT_LOCAL"))),
        ("late", LATCHED.format("late", "subscription", "print, " + KEEPS.format("VOLATILE"))),
    )
    for path, text in {
        "{0}/package.xml": OF_ROS2.format(name),
        "{0}/setup.py": f"from setuptools import setup\nsetup(name='{name}', packages=['{name}'], "
        f"entry_points={{'console_scripts': ['{name} = {name}.run:main']}})\n",
        "{0}/{0}/__init__.py": "",
        "{0}/{0}/run.py": "def main():\n" + "".join(f"    {line}\n" for line in source.splitlines()),
    }.items()
}
LEFT_OUT = {
    "core/package.xml": MANIFEST.format("core", ""),
    "core/CMakeLists.txt": BUILD.format("core"),
    "core/maps/hall.yaml": "image: hall.png\n",
    "user/package.xml": MANIFEST.format("user", "<depend>core</depend>"),
    "user/CMakeLists.txt": BUILD.format("user"),
    "user/launch/a.launch": "<launch>\n  <arg name='map' default='$(find core)/maps/hall.yaml'/>\n</launch>\n",
}
GONE = "<launch>\n  <include file='$(find core)/launch/gone.launch'/>\n</launch>\n"
LISTED = "repositories:\n  arm_tools_of_ours:\n    type: git\n    url: https://example.org/a.git\n    version: main\n"


def written(folder: Path, files: dict[str, str]) -> Path:
    for path, text in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text)
        (folder / path).chmod(0o755)
    return folder


@pytest.mark.parametrize(
    ("rule", "files", "package"),
    [
        ("LNT036", ROBOT | PLAIN | {"README.md": "For ROS Noetic."}, "arm"),
        ("LNT036", ROBOT | PLAIN | {"README.md": "For ROS Hydro."}, None),
        ("LNT036", ROBOT | PLAIN | {".github/workflows/a.yml": "distribution: hydro\n"}, None),
        ("LNT055", ROBOT | PLAIN, "arm"),
        ("LNT055", ROBOT | PLAIN | {"all.repos": LISTED}, None),
        ("LNT046", LIBRARY, "core"),
        ("LNT007", STARTED, "panel"),
        ("LNT002", DESCRIBED, "parts"),
        ("LNT001", LEFT_OUT | {"user/launch/b.launch": GONE}, "user"),
        ("LNT061", PLAIN | ROBOT | {"arm/urdf/a.urdf": "<robot><link></robot>\n"}, "arm"),
        ("LNT035", NOTHING_OF, "user"),
        ("LNT043", LEFT_OUT, "core"),
        ("LNT053", LATE, "late"),
        ("LNT001", NAMELESS, "arm"),
        ("LNT014", TWICE, "core"),
        ("LNT036", MARKED, "core user"),
        ("LNT036", HIDDEN, "core"),
    ],
)
def test_what_the_tree_and_other_packages_tell(
    rule: str, files: dict[str, str], package: str | None, tmp_path: Path
) -> None:
    """Files outside of packages, and nodes, launch files and descriptions of other packages, concern a package too."""
    both = sides(written(tmp_path, files))
    assert both.alone == both.together
    lines = [each.evidence[0].path for each in findings_of(both.whole, (rule,))]
    assert {path.partition("/")[0] for path in lines} == set(package.split() if package else ())


def test_a_line_of_another_state_of_a_file_is_no_line_of_the_tree(tmp_path: Path) -> None:
    """The document of the user tells lines of the library as it was then."""
    tree = written(tmp_path, LIBRARY)
    documents = stored(tree)
    source = tree / "core/src/core/server.py"
    source.write_text("# one line more\n" + source.read_text())
    found = [each for each in alone(tree, "core/", documents) if each.rule == "LNT046"]
    assert [each.evidence[0].line for each in found] == [7]


def test_workflows_of_repositories_in_folders_are_read(tmp_path: Path) -> None:
    """A workspace holds repositories in folders."""
    files = {f"repository/{path}": text for path, text in (ROBOT | PLAIN).items()}
    tree = written(tmp_path, files | {"repository/.github/workflows/a.yml": "distribution: hydro\n"})
    assert not findings_of(Workspace(open_tree(tree), Options(jobs=1)), ("LNT036",))


def test_what_a_document_does_not_keep_is_told(tmp_path: Path) -> None:
    """A launch file that may start what is under lint, and that no document keeps, leaves the answer open."""
    tree = written(tmp_path, STARTED | {"bringup/launch/more.launch": "<launch>\n</launch>\n"})
    folder = "<include file='$(find bringup)/launch/big.launch'/>"
    (tree / "bringup/launch/more.launch").write_text(f"<launch>\n  {folder}\n</launch>\n")
    (tree / "bringup/launch/big.launch").write_bytes(b"<launch>\n  <!-- \xff -->\n</launch>\n")
    workspace = Workspace(open_tree(tree / "panel"), Options(jobs=1), stored=stored(tree))
    findings_of(workspace)
    assert [each.unread.reason for each in workspace.tree.diagnostics if each.unread] == ["unjudged"]


def test_a_macro_of_a_file_that_no_document_keeps_is_not_missing(tmp_path: Path) -> None:
    """What was not read may define it."""
    files = DESCRIBED | {"parts/urdf/hand.xacro": XACRO.format("", "<!-- \xff -->")}
    whole = "whole/urdf/robot.urdf.xacro"
    files[whole] = files[whole].replace("\n</robot>", "<xacro:a/>\n</robot>")
    tree = written(tmp_path, files)
    (tree / "parts/urdf/hand.xacro").write_bytes(files["parts/urdf/hand.xacro"].encode("latin-1"))
    assert "LNT002" not in {each.rule for each in alone(tree, "whole/", stored(tree))}


def test_each_package_that_installs_nothing_is_told(tmp_path: Path) -> None:
    """One that is added is no part of what was said of another."""
    both = sides(written(tmp_path, OF_DEVEL))
    assert both.alone == both.together
    found = findings_of(both.whole, ("LNT043",))
    assert [(each.subjects, each.severity) for each in found] == [(("first",), "info"), (("second",), "info")]
    assert len({each.fingerprint for each in found}) == len(found)


def test_files_of_other_packages_are_named_from_there(tmp_path: Path) -> None:
    """Wherever the other package lies, in a tree or as a document of another one."""
    tree = written(
        tmp_path, {f"src/{path}": text for path, text in (LEFT_OUT | {"user/launch/b.launch": GONE}).items()}
    )
    both = findings_of(Workspace(open_tree(tree), Options(jobs=1))), alone(tree / "src", "user/", stored(tree / "src"))
    messages = [[each.message for each in found if each.rule == "LNT001"] for found in both]
    assert [each.partition(" names ")[2].partition(",")[0] for found in messages for each in found] == [
        "core/launch/gone.launch"
    ] * 2
