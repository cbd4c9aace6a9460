"""What is said of files of ROS 1 that lie in packages of ROS 2, and of one cause that is seen twice."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

LAUNCH = """<launch>
  <arg name="goal" default="$(find pkg)/config/gone.yaml"/>
  <rosparam command="load" file="$(arg goal)"/>
</launch>
"""
PUBLISHER = "import rospy\n\npub = rospy.Publisher('/map', String)\n"


def severities(workspace: Workspace, rule: str) -> list[str]:
    return [each.severity for each in lint(workspace.root) if each.rule == rule]


@pytest.mark.parametrize(("ros", "launch", "python"), [(1, "error", "warning"), (2, "info", "info")])
def test_files_of_ros1_in_packages_of_ros2(ros: int, launch: str, python: str, workspace: Workspace) -> None:
    """Nothing of ROS 2 loads them, so that what is wrong in them breaks nothing; in ROS 1 it does."""
    cmake = "project(pkg)\ninstall(DIRECTORY launch config DESTINATION share/pkg)\n"
    files = {"launch/a.launch": LAUNCH, "config/a.yaml": "a: 1\n", "scripts/a.py": PUBLISHER, "CMakeLists.txt": cmake}
    workspace.package(files, ros)
    assert severities(workspace, "LNT034") == [python]
    assert launch in severities(workspace, "LNT001")


def test_a_file_that_an_argument_names_and_a_parameter_loads(workspace: Workspace) -> None:
    """LNT001: one file that is missing is one finding, and the graver one."""
    cmake = "project(pkg)\ncatkin_package()\ninstall(DIRECTORY launch config DESTINATION share/pkg)\n"
    workspace.package({"launch/a.launch": LAUNCH, "config/a.yaml": "a: 1\n", "CMakeLists.txt": cmake}, 1)
    assert severities(workspace, "LNT001") == ["error"]


def test_a_missing_file_is_one_cause_wherever_its_package_lies(workspace: Workspace) -> None:
    """LNT001: the fingerprint names the package, not the folder that was asked for."""
    workspace.package({"launch/a.launch": LAUNCH}, 1)
    whole, alone = (
        {each.fingerprint for each in lint(root) if each.rule == "LNT001"}
        for root in (workspace.root, workspace.root / "pkg")
    )
    assert whole == alone != set()


def test_packages_that_use_each_other(workspace: Workspace) -> None:
    """LNT004: only one of two can ask for the other, so that neither is told to; who is used alone is asked for."""
    for name, used in (("arm", "hand"), ("hand", "arm"), ("robot", "arm")):
        launch = f'<launch><include file="$(find {used})/launch/a.launch"/></launch>'
        workspace.package({"launch/a.launch": launch}, 1, name)
    found = {(each.subjects[0], each.severity) for each in lint(workspace.root) if each.rule == "LNT004"}
    assert found == {("arm", "info"), ("hand", "info"), ("robot", "warning")}


BASE = '<launch><node pkg="move_base" type="move_base" name="ROBOT"/></launch>'
PLANNER = '<launch><node pkg="planner" type="planner" name="a"><remap from="/goal" to="/ROBOT/goal"/></node></launch>'


@pytest.mark.parametrize(("included", "severity"), [(("base", "planner"), "warning"), (("planner",), "info")])
def test_a_node_that_is_started_elsewhere(included: tuple[str, ...], severity: str, workspace: Workspace) -> None:
    """LNT042: a node that no launch starts together with who is told its name may be called so by chance."""
    lines = "".join(f'<include file="$(find pkg)/launch/{name}.launch"/>' for name in included)
    files = {"base.launch": BASE, "planner.launch": PLANNER, "all.launch": f"<launch>{lines}</launch>"}
    workspace.package({f"launch/{name}": text for name, text in files.items()}, 1)
    assert severities(workspace, "LNT042") == [severity]
