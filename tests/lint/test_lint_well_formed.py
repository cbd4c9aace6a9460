"""Files that a strict reader refuses (LNT061), and packages that cannot be called so (LNT067)."""

from __future__ import annotations

from pathlib import Path

import pytest
from lint_fixtures import lint
from workspaces import Workspace

XACRO = '<robot xmlns:xacro="http://ros.org/wiki/xacro" name="r"><xacro:property name="a" value="1"/></robot>'
ROWS = [
    ("launch/a.launch", '<launch><arg name="a" doc="b & c"/></launch>', True),
    ("launch/a.launch", '<launch><arg name="a" doc="b &amp; c"/></launch>', False),
    ("launch/a.launch", "<launch><group></launch>", True),
    ("launch/a.launch", "", False),
    ("templates/a.launch", "<launch><group></launch>", False),
    ("launch/a.launch", "<launch>{{ nodes }}<group></launch>", False),
    ("urdf/a.xacro", XACRO, False),
    ("urdf/a.xacro", '<robot name="r"><xacro:property name="a" value="1"/></robot>', True),
    ("CMakeLists.txt", "project(pkg)\n", False),
    ("CMakeLists.txt", "project(pkg))\n", True),
    ("CMakeLists.txt", "project(pkg\n", True),
    ("CMakeLists.txt", "project(pkg)\nendif()\n", True),
    ("src/pkg/node.py", "def f():\nreturn 1\n", True),
    ("src/pkg/node.py", "print 'a'\n", False),
    ("scripts/node", "#!/usr/bin/env python\nimport rospy\nif rospy\n    pass\n", True),
    ("scripts/node.py", "def @(name)(:\n    pass\n", False),
    ("docs/conf.py", "if a\n", False),
    ("test/node.py", "if a\n", False),
    ("config/.node.py", "if a\n", False),
    ("setup.py", "setup(name='a' version='1')\n", True),
    ("config/a.yaml", "a: 1\n<<<<<<< HEAD\nb: 1\n=======\nb: 2\n>>>>>>> x\nc:\n  d: 1\n", True),
    ("config/a.yaml", "a: 1\n---\nb: !degrees 2\n", False),
    ("config/a.yaml", "a: {{ b }}: c\n", False),
    ("test/a.yaml", "a: b: c\n", False),
]
SETUP = (
    "from setuptools import setup\nsetup(name='pkg', packages=['pkg'], "
    "entry_points={'console_scripts': ['node = pkg.node:main']})\n"
)
OF_ROS_2 = [
    ("launch/a.launch.py", "if a\n", "error"),
    ("pkg/node.py", "print 'a'\n", "error"),
    ("pkg/node.py", "print('a')\n", ""),
    ("pkg/node.py", "import rospy\nprint 'a'\n", "info"),
    ("pkg/part.py", "print 'a'\n", "error"),
    ("pkg/piece.py", "print 'a'\n", "info"),
    ("tools/draw.py", "print 'a'\n", "info"),
]
MANIFEST = "<package{}><name>{}</name><version>1.0.0</version>{}</package>"
MANIFESTS = [
    (MANIFEST.format("", "pkg", "<run_depend>roscpp</run_depend>"), False),
    (MANIFEST.format("", "pkg", "<exec_depend>roscpp</exec_depend>"), True),
    (MANIFEST.format(" format='3'", "pkg", "<run_depend>roscpp</run_depend>"), True),
    (MANIFEST.format(" format='3'", "my pkg", ""), True),
]


@pytest.mark.parametrize(("path", "text", "expected"), ROWS)
def test_well_formed(workspace: Workspace, path: str, text: str, expected: bool) -> None:
    """Templates become what they should be later."""
    found = [finding.rule for finding in lint(workspace.package({path: text}, ros=1).root)]
    assert ("LNT061" in found) is expected


@pytest.mark.parametrize(("path", "text", "level"), OF_ROS_2)
def test_python_of_ros_2(workspace: Workspace, path: str, text: str, level: str) -> None:
    """It is Python 3, whoever wrote it for another; what nothing starts or imports is an info."""
    files = {"setup.py": SETUP, "pkg/__init__.py": "", "pkg/other.py": "from pkg.part import run\n", path: text}
    found = lint(workspace.package(files, ros=2).root)
    assert [finding.severity for finding in found if finding.rule == "LNT061"] == ([level] if level else [])


@pytest.mark.parametrize(("text", "expected"), MANIFESTS)
def test_manifests(tmp_path: Path, text: str, expected: bool) -> None:
    """A build tool refuses what its format does not have."""
    (tmp_path / "package.xml").write_text(text)
    assert ("LNT061" in [finding.rule for finding in lint(tmp_path)]) is expected


@pytest.mark.parametrize(
    ("name", "expected"), [("demo_nodes_cpp", False), ("demo_nodes_cpp ", True), ("demo nodes", True), ("", False)]
)
def test_impossible_package(workspace: Workspace, name: str, expected: bool) -> None:
    """Nobody finds a package by a name that has blanks."""
    launch = f'<launch><node pkg="{name}" exec="talker"/><node pkg="$(var a)" exec="b"/></launch>'
    found = lint(workspace.package({"launch/a.launch.xml": launch}, ros=2).root)
    assert ("LNT067" in [finding.rule for finding in found]) is expected


def test_impossible_dependency(tmp_path: Path) -> None:
    """A manifest that lists two names in one tag depends on neither; keys of rosdep have dots."""
    depends = "<depend>rclcpp std_msgs</depend><depend>libfoo1.0</depend>"
    (tmp_path / "package.xml").write_text(MANIFEST.format(" format='3'", "pkg", depends))
    found = [finding.message for finding in lint(tmp_path) if finding.rule == "LNT067"]
    assert [("'rclcpp std_msgs'" in message) for message in found] == [True]
