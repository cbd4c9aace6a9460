"""What was false or noise on repositories that nobody had looked at; each row fails without its fix."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from git_repos import commit_all
from lint_fixtures import lint

from ecm_extract.entities.distributions import is_for_older
from ecm_extract.tree import left_out, open_tree

CATKIN = "cmake_minimum_required(VERSION 3.5)\nproject(pkg)\nfind_package(catkin REQUIRED)\ncatkin_package({})\n"
AMENT = "cmake_minimum_required(VERSION 3.8)\nproject(pkg)\nfind_package(ament_cmake REQUIRED)\n{}ament_package()\n"
MAIN = "int main() { return 0; }\n"
SHEBANG = "#!/usr/bin/env python3\nprint('on')\n"
XACRO = '<robot name="a" xmlns:xacro="http://ros.org/wiki/xacro">{}</robot>'
MESH = XACRO.format('<link name="l"><visual><geometry><mesh filename="package://pkg/{}"/></geometry></visual></link>')
ENDS = '<parent link="l"/><child link="m"/>'
JOINT = XACRO.format(f'<link name="l"/><link name="m"/><joint name="j" type="{{}}">{ENDS}{{}}</joint>')
LIMIT = '<limit lower="-3.142" upper="3.142" effort="1" velocity="1"/>'


HOME = """\
import os
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    f = os.path.join(os.path.expanduser('~'), 'a.yaml')
    return LaunchDescription([Node(package='x', executable='y', parameters=[f])])
"""
CONTROLLER = "{}:\n  type: effort_controllers/JointTrajectoryController\n  joints: [j]\n"
MANAGED = """\
<launch>
  <rosparam command="load" file="$(find pkg)/c.yaml"/>
  <node name="s" pkg="controller_manager" type="controller_manager" args="spawn a"/>
  <node name="t" pkg="controller_manager" type="controller_manager" args="load b"/>
</launch>
"""
RENAMED = "install(PROGRAMS s/go.py DESTINATION lib/pkg RENAME go)\n"
LOOP = """\
file(GLOB S src/*.cpp)
foreach(f ${S})
  get_filename_component(n ${f} NAME_WE)
  add_executable(${n} ${f})
endforeach()
"""
GLOB = "file(GLOB_RECURSE L launch/*.launch)\ninstall(FILES ${L} DESTINATION share/pkg)\n"
PROPERTY = '<xacro:property name="c" value="{}"/><link name="${{c}}_l"/>'
CALIBRATION = '<launch><param name="u" value="file://$(find pkg)/a.yaml"/></launch>'
SETUP = "from setuptools import setup\nsetup(name='pkg', entry_points={'console_scripts': ['go = pkg.go:main']})\n"


def started(name: str, kind: str = "type") -> str:
    return f'<launch>\n<node pkg="pkg"\n  name="n"\n  {kind}="{name}"/>\n</launch>\n'


def levels(workspace: Any, files: dict[str, str], ros: int) -> dict[str, str]:
    workspace.package(files, ros=ros)
    return {finding.rule: finding.severity for finding in reversed(lint(workspace.root))}


QUIET = [
    (
        "a renamed script",
        "LNT003",
        2,
        {
            "CMakeLists.txt": AMENT.format(RENAMED),
            "s/go.py": SHEBANG,
            "launch/a.launch.xml": started("go", "exec"),
        },
    ),
    (
        "a script that is installed, and a module of its name",
        "LNT043",
        2,
        {
            "CMakeLists.txt": AMENT.format(
                "install(PROGRAMS scripts/go.py DESTINATION lib/pkg)\ninstall(DIRECTORY launch DESTINATION share/pkg)\n"
            ),
            "scripts/go.py": SHEBANG,
            "pkg_py/__init__.py": "",
            "pkg_py/go.py": "def main():\n    pass\n",
            "launch/a.launch.xml": started("go.py", "exec"),
        },
    ),
    (
        "a loop over a pattern",
        "LNT003",
        1,
        {
            "CMakeLists.txt": CATKIN.format("") + LOOP,
            "src/go.cpp": MAIN,
            "launch/a.launch": started("go"),
        },
    ),
    (
        "rosbuild's command",
        "LNT003",
        1,
        {
            "CMakeLists.txt": "rosbuild_init()\nrosbuild_add_executable(go src/go_node.cpp)\n",
            "src/go_node.cpp": MAIN,
            "launch/a.launch": started("go"),
        },
    ),
    (
        "a build file that CMake refuses",
        "LNT003",
        1,
        {"CMakeLists.txt": CATKIN.format("") + "add_executable(a a.cpp\n", "launch/a.launch": started("go")},
    ),
    (
        "a download that builds",
        "LNT044",
        1,
        {
            "CMakeLists.txt": "include(ExternalProject)\n"
            + CATKIN.format("LIBRARIES pkg_core")
            + "ExternalProject_Add(core URL a)\n"
        },
    ),
    (
        "files of any depth",
        "LNT043",
        1,
        {
            "CMakeLists.txt": CATKIN.format("") + GLOB,
            "launch/a.launch": "<launch/>",
            "launch/b/c/d.launch": "<launch/>",
        },
    ),
    ("a turning joint", "LNT016", 1, {"urdf/a.urdf": JOINT.format("continuous", LIMIT)}),
    (
        "its own temperature",
        "LNT024",
        1,
        {
            "msg/Temperature.msg": "float32 t\n",
            "src/a.cpp": "void f(Pub p) { pkg::Temperature t; t.t = 1; p.publish(t); }\n",
        },
    ),
    (
        "a source that the build leaves out",
        "LNT024",
        1,
        {
            "CMakeLists.txt": CATKIN.format("") + "add_executable(b b.cpp)\n",
            "b.cpp": "int main() {}\n",
            "a.cpp": "void f(Pub p) { sensor_msgs::Image t; t.height = 1; p.publish(t); }\n",
        },
    ),
    ("data of a test", "LNT061", 2, {"test_data/a.yaml": "a: [1, 2\n"}),
    (
        "a home folder",
        "LNT001",
        2,
        {"launch/a.launch.py": HOME},
    ),
    (
        "loaded, not started",
        "LNT013",
        1,
        {
            "c.yaml": CONTROLLER.format("a") + CONTROLLER.format("b"),
            "launch/a.launch": MANAGED,
        },
    ),
    (
        "a macro of the machine",
        "LNT002",
        1,
        {"urdf/a.xacro": XACRO.format('<xacro:include filename="/home/me/b.xacro"/><xacro:wheel/>')},
    ),
    (
        "a name that means another",
        "LNT022",
        1,
        {"urdf/a.xacro": XACRO.format(PROPERTY.format("x") + PROPERTY.format("y"))},
    ),
    (
        "a package in a comment",
        "LNT004",
        1,
        {"launch/a.launch": '<launch>\n<!-- <node pkg="other" type="a" name="a"/> -->\n</launch>'},
    ),
    (
        "a hidden folder",
        "LNT001",
        1,
        {"launch/.copies/a.launch": '<launch><include file="$(find pkg)/launch/b.launch"/></launch>'},
    ),
]


@pytest.mark.parametrize(("rule", "ros", "files"), [row[1:] for row in QUIET], ids=[row[0] for row in QUIET])
def test_quiet(workspace: Any, rule: str, ros: int, files: dict[str, str]) -> None:
    """What is made, found or meant in another way is not told."""
    assert rule not in levels(workspace, files, ros)


LEVELS = [
    (
        "nothing is installed",
        "LNT043",
        1,
        {
            "CMakeLists.txt": CATKIN.format("") + "add_executable(a a.cpp)\n",
            "a.cpp": MAIN,
            "launch/a.launch": started("a"),
        },
        "info",
    ),
    (
        "a launched script of ROS 2",
        "LNT043",
        2,
        {"CMakeLists.txt": AMENT.format(""), "scripts/go.py": SHEBANG, "launch/a.launch.xml": started("go.py", "exec")},
        "error",
    ),
    (
        "pi of four digits",
        "LNT016",
        1,
        {"urdf/a.urdf": JOINT.format("revolute", LIMIT.replace("3.142", "3.1416"))},
        "warning",
    ),
    ("pi of three digits", "LNT016", 1, {"urdf/a.urdf": JOINT.format("revolute", LIMIT)}, "warning"),
    (
        "a calibration",
        "LNT001",
        1,
        {
            "CMakeLists.txt": CATKIN.format(""),
            "launch/a.launch": CALIBRATION,
        },
        "info",
    ),
    (
        "a script of Python that setup.py leaves out",
        "LNT003",
        2,
        {
            "setup.py": SETUP,
            "pkg/drive.py": SHEBANG,
            "launch/a.launch.xml": started("drive.py", "exec"),
        },
        "error",
    ),
]


@pytest.mark.parametrize(("rule", "ros", "files", "level"), [row[1:] for row in LEVELS], ids=[row[0] for row in LEVELS])
def test_level(workspace: Any, rule: str, ros: int, files: dict[str, str], level: str) -> None:
    """How bad it is depends on what is certain, and on what follows."""
    assert levels(workspace, files, ros).get(rule) == level


def test_of_a_refused_file_nothing_else_is_said(workspace: Any) -> None:
    """What was understood of a file that its reader refuses is worth nothing."""
    text = '<launch>\n<include file="$(find pkg)/launch/b.launch"/>\n<node pkg="pkg" type="a" name=a/>\n</launch>'
    workspace.package({"launch/a.launch": text}, ros=1)
    assert [finding.rule for finding in lint(workspace.root)] == ["LNT061"]


@pytest.mark.parametrize(("ros", "follows"), [(1, "roslaunch reports it"), (2, "launch_ros finds no such program")])
def test_what_follows_depends_on_the_launcher(workspace: Any, ros: int, follows: str) -> None:
    """The one goes on where the other stops; the line is that of the name."""
    build = {1: CATKIN.format(""), 2: AMENT.format("")}[ros] + "add_executable(base a.cpp)\n"
    suffix, kind = {1: ("launch", "type"), 2: ("launch.xml", "exec")}[ros]
    workspace.package({"CMakeLists.txt": build, "a.cpp": MAIN, f"launch/a.{suffix}": started("bose", kind)}, ros=ros)
    (found,) = [each for each in lint(workspace.root) if each.rule == "LNT003"]
    assert follows in found.message
    assert found.evidence[0].line == 4


def test_users_of_one_module_are_one_finding(workspace: Any) -> None:
    """A package that exports nothing is the cause, not each who imports from it."""
    users = {f"scripts/{name}.py": f"from pkg.arm import {name}\n" for name in ("up", "down", "stop")}
    workspace.package({"src/pkg/__init__.py": "", "src/pkg/arm.py": "speed = 1\n", **users}, ros=1)
    (found,) = [each for each in lint(workspace.root) if each.rule == "LNT011"]
    assert len(found.evidence) == 3


def test_what_a_sparse_checkout_leaves_out_is_not_missing(tmp_path: Path) -> None:
    """Git tracks the mesh; a mesh that was deleted is missing all the same."""
    package = tmp_path / "pkg"
    for name in ("urdf", "meshes"):
        (package / name).mkdir(parents=True)
    (package / "package.xml").write_text("<package format='2'><name>pkg</name><version>1.0.0</version></package>")
    (package / "meshes" / "a.stl").write_text("solid a")
    (package / "meshes" / "b.stl").write_text("solid b")
    (package / "urdf" / "a.urdf").write_text(MESH.format("meshes/a.stl"))
    commit_all(tmp_path)
    (package / "meshes" / "a.stl").unlink()
    assert left_out(open_tree(tmp_path)) == frozenset()
    assert "LNT025" in [finding.rule for finding in lint(tmp_path)]
    (tmp_path / ".git" / "info").mkdir(exist_ok=True)
    (tmp_path / ".git" / "info" / "sparse-checkout").write_text("urdf\n")
    assert left_out(open_tree(tmp_path)) == {"pkg/meshes/a.stl"}
    assert "LNT025" not in [finding.rule for finding in lint(tmp_path)]


@pytest.mark.parametrize(
    ("since", "named", "expected"),
    [
        ("ROS Jade; gone in Noetic", {"indigo"}, True),
        ("ROS Jade; gone in Noetic", {"noetic"}, False),
        ("ROS 2 Humble", {"foxy", "humble"}, True),
        ("ROS 2 Humble", {"indigo"}, False),
        ("Boost 1.53", {"indigo"}, False),
    ],
)
def test_advice_for_an_older_distribution(since: str, named: set[str], expected: bool) -> None:
    """What a named distribution lacks is no advice for it; the two ROS have lines of their own."""
    assert is_for_older(since, frozenset(named)) is expected
