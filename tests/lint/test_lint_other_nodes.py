"""What a rule asks of a node is asked of none whose name, or whose receiver, says that it is meant otherwise."""

from __future__ import annotations

import near_miss_files as files_of
import pytest
from lint_fixtures import lint
from workspaces import Workspace


@pytest.mark.parametrize(("other", "severity"), [("monitor", "info"), ("other", "warning")])
def test_parameters_of_another_node(workspace: Workspace, other: str, severity: str) -> None:
    """LNT046: what a node reads below the name of one that is started is of that one."""
    files = dict(files_of.read_below("/monitor"))
    files["scripts/b.py"] = files_of.script("b", "rospy.set_param('~low', 1)")
    files["launch/a.launch"] = files_of.launch(files_of.node("watch", "monitor.py"), files_of.node(other, "b.py"))
    assert _severities(workspace, files, "LNT046") == [severity]


@pytest.mark.parametrize(
    ("topics", "severity"),
    [
        (("mavros/setpoint_position/local",), "info"),
        (("mavros/setpoint_position/local", "goal"), "warning"),
        (("goal",), "warning"),
    ],
)
def test_receivers_that_need_no_header(workspace: Workspace, topics: tuple[str, ...], severity: str) -> None:
    """LNT024: they do where all that is published of the type goes to topics of the table."""
    made = "".join(f'n.advertise<geometry_msgs::PoseStamped>("{topic}", 1);' for topic in topics)
    body = "geometry_msgs::PoseStamped ps; ps.pose.position.x = 1; pub.publish(ps);"
    code = f'int main(int c, char **v) {{ ros::init(c, v, "a"); ros::NodeHandle n; auto pub = {made} {body} }}\n'
    files = {"src/a.cpp": code, "CMakeLists.txt": files_of.CMAKE.format("a")}
    assert _severities(workspace, files, "LNT024") == [severity]


@pytest.mark.parametrize(("space", "severity"), [("", "warning"), (' ns="camera"', "info")])
def test_a_name_that_is_relative_elsewhere(workspace: Workspace, space: str, severity: str) -> None:
    """LNT042: without its slash the name of a manager would lie in the group of the node that is loaded."""
    manager = '<node name="manager" pkg="nodelet" type="nodelet" args="manager"/>'
    loaded = '<node name="driver" pkg="nodelet" type="nodelet" args="load pkg/Driver /manager"/>'
    files = {
        "launch/camera.launch": f"<launch>{manager}<group{space}>{loaded}</group></launch>",
        "launch/all.launch": '<launch><include file="$(find pkg)/launch/camera.launch"/></launch>',
    }
    assert _severities(workspace, files, "LNT042") == [severity]


def _severities(workspace: Workspace, files: files_of.Files, rule: str) -> list[str]:
    found = lint(workspace.package(dict(files), ros=1).root)
    return [each.severity for each in found if each.rule == rule]


@pytest.mark.parametrize(("second", "told"), [("gripper", 1), ("ab_node", 2)])
def test_programs_that_went_together(workspace: Workspace, second: str, told: int) -> None:
    """LNT003: what one launch file lacks is one cause; a name that nearly is one that is built is another."""
    files = {
        "src/aa_node.cpp": "int main() {}\n",
        "CMakeLists.txt": files_of.CMAKE.format("aa_node"),
        "launch/a.launch": files_of.launch(files_of.node("x", "other_program"), files_of.node("y", second)),
    }
    assert len(_severities(workspace, files, "LNT003")) == told
