"""Frames, command interfaces and files of robot descriptions, nodes of behaviour trees, and who names them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import package, release, write

from ecm_extract.cli.run import run

ROBOT = """<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="cell">
<link name="base_link"/>
<link name="${{prefix}}{camera}"/>
<ros2_control name="hw" type="system"><joint name="wrist">
{commands}
</joint></ros2_control>
</robot>
"""
VELOCITY = '<command_interface name="velocity"/>'
LOOKUP = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from tf2_ros import Buffer
class Eye(Node):
    def __init__(self):
        super().__init__('eye')
        self.buffer = Buffer()
        self.buffer.lookup_transform('base_link', 'camera_optical_frame', rclpy.time.Time())
if __name__ == '__main__':
    rclpy.spin(Eye())
"""
XACRO = '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" name="mine">\n{}\n</robot>\n'
TREES = """#include <behaviortree_cpp/bt_factory.h>
class Go : public BT::SyncActionNode {{
public:
  static BT::PortsList providedPorts() {{ return {{BT::InputPort<double>("{port}")}}; }}
}};
BT_REGISTER_NODES(factory) {{ factory.registerNodeType<Go>("{name}"); }}
"""


def compared(folder: Path, capsys: pytest.CaptureFixture[str], consumer: dict[str, str | None]) -> dict[str, Any]:
    write(folder / "user", {"package.xml": package("user"), **consumer})
    run(
        [
            "diff",
            "1.0.0",
            "2.0.0",
            "--repo",
            str(folder / "cell"),
            "--consumer",
            str(folder / "user"),
            "--format",
            "json",
        ]
    )
    found: dict[str, Any] = json.loads(capsys.readouterr().out)
    return found


def told(found: dict[str, Any]) -> set[tuple[str, str, str | None, str | None, bool]]:
    return {(c["kind"], c["change"], c["old"], c["new"], c["breaking"]) for c in found["changes"]}


def robots(folder: Path, before: str, after: str | None, path: str = "urdf/cell.xacro") -> None:
    release(folder / "cell", {"package.xml": package("cell"), "urdf/cell.xacro": before}, "1.0.0")
    files: dict[str, str | None] = {"urdf/cell.xacro": None} if path != "urdf/cell.xacro" or after is None else {}
    release(folder / "cell", {**files, **({path: after} if after is not None else {})}, "2.0.0")


@pytest.mark.parametrize(
    ("path", "text", "line"),
    [
        ("eye/eye.py", LOOKUP, 9),
        ("params.yaml", "eye:\n  ros__parameters:\n    target_frame: camera_optical_frame\n", 3),
        ("mine.xacro", XACRO.format('<joint name="j"><parent link="camera_optical_frame"/></joint>'), 2),
    ],
)
def test_who_names_a_renamed_frame_breaks(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], path: str, text: str, line: int
) -> None:
    """Whether a program looks it up, a parameter names it or a joint hangs on it; a prefix is empty by default."""
    names = ("camera_optical_frame", "camera_frame_optical")
    robots(tmp_path, *(ROBOT.format(camera=name, commands=VELOCITY) for name in names))
    found = compared(tmp_path, capsys, {path: text})
    assert told(found) == {("frame", "renamed", *names, True)}
    (finding,) = found["findings"]
    assert (finding["rule"], finding["evidence"][0]["path"], finding["evidence"][0]["line"]) == ("VER001", path, line)
    assert names[1] in finding["resolution"]


def test_a_frame_of_ones_own_is_no_use(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Who declares a link of the same name means that one."""
    robots(tmp_path, *(ROBOT.format(camera=name, commands="") for name in ("eye_link", "ear_link")))
    own = '<link name="eye_link"/><joint name="j"><parent link="eye_link"/></joint>'
    assert compared(tmp_path, capsys, {"mine.xacro": XACRO.format(own)})["findings"] == []


def test_arguments_of_a_description(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Who gives one that is gone gives it for nothing; a file that goes takes its own with it."""
    before = XACRO.format('<xacro:arg name="side" default="left"/><xacro:arg name="imu_x" default="0"/>')
    after = XACRO.format('<xacro:arg name="side" default="right"/><xacro:arg name="imu_xyz" default="0 0 0"/>')
    robots(tmp_path, before, after)
    found = {entry for entry in told(compared(tmp_path, capsys, {})) if entry[0] == "xacro_argument"}
    assert found == {
        ("xacro_argument", "default_changed", "side", "side", False),
        ("xacro_argument", "removed", "imu_x", None, True),
        ("xacro_argument", "added", None, "imu_xyz", False),
    }


PYTHON = """from launch import LaunchDescription
from launch.substitutions import Command, FindExecutable, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare('cell'), 'urdf', 'cell.xacro'])
    words = [{program}, ' ', path, ' side:=', LaunchConfiguration('side'), ' {argument}:=1']
    robot = {{'robot_description': ParameterValue(Command(words), value_type=str)}}
    return LaunchDescription([Node(package='robot_state_publisher', executable='robot_state_publisher',
                                   parameters=[robot])])
"""
XML = """<launch>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description"
           value="$(command 'xacro $(find-pkg-share {package})/urdf/cell.xacro side:=$(var side) {argument}:=1')"/>
  </node>
</launch>
"""


@pytest.mark.parametrize(
    ("path", "text", "line"),
    [
        ("launch/a.launch.xml", XML.format(package="cell", argument="imu_x"), 3),
        ("launch/a.launch.py", PYTHON.format(program="'xacro'", argument="imu_x"), 12),
        ("launch/a.launch.py", PYTHON.format(program="FindExecutable(name='xacro')", argument="imu_x"), 12),
        ("launch/a.launch.py", PYTHON.format(program="'cat'", argument="imu_x"), None),
        ("launch/a.launch.xml", XML.format(package="cell", argument="imu_y"), None),
        ("launch/a.launch.xml", XML.format(package="other", argument="imu_x"), None),
    ],
)
def test_who_gives_an_argument_that_is_gone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], path: str, text: str, line: int | None
) -> None:
    """A launch file that hands xacro a value for it is told, and no other."""
    before = '<xacro:arg name="side" default="left"/><xacro:arg name="imu_x" default="0"/>'
    robots(tmp_path, XACRO.format(before), XACRO.format('<xacro:arg name="side" default="left"/>'))
    found = compared(tmp_path, capsys, {path: text})["findings"]
    assert [(each["rule"], each["evidence"][0]["line"]) for each in found] == ([("VER001", line)] if line else [])


def test_a_command_interface_that_is_gone(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Controllers that claim it are refused."""
    robots(tmp_path, ROBOT.format(camera="eye", commands=VELOCITY), ROBOT.format(camera="eye", commands=""))
    found = compared(tmp_path, capsys, {})
    assert told(found) == {("command_interface", "removed", "wrist/velocity", None, True)}


def test_names_are_where_they_were_when_their_file_moves(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A frame has no file in the graph; only who includes the file must follow."""
    text = ROBOT.format(camera="eye", commands=VELOCITY)
    robots(tmp_path, text, text, "robots/cell.xacro")
    include = '<xacro:include filename="$(find cell)/urdf/cell.xacro"/>'
    found = compared(tmp_path, capsys, {"mine.xacro": XACRO.format(include)})
    assert {(c["kind"], c["breaking"]) for c in found["changes"]} == {("file", True)}
    assert [entry["evidence"][0]["path"] for entry in found["findings"]] == ["mine.xacro"]


def test_names_go_with_their_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """One cause, one change."""
    robots(tmp_path, ROBOT.format(camera="eye", commands=VELOCITY), None)
    assert told(compared(tmp_path, capsys, {})) == {("file", "removed", "urdf/cell.xacro", None, True)}


@pytest.mark.parametrize(
    ("after", "change", "what"),
    [
        ({"name": "Drive", "port": "speed"}, "bt_node", "names the node Go"),
        ({"name": "Go", "port": "velocity"}, "bt_port", "sets the port speed of Go"),
    ],
)
def test_trees_of_consumers_break(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], after: dict[str, str], change: str, what: str
) -> None:
    """A tree that names a node or port of before does not load."""
    for tag, names in (("1.0.0", {"name": "Go", "port": "speed"}), ("2.0.0", after)):
        release(tmp_path / "cell", {"package.xml": package("cell", tag), "src/go.cpp": TREES.format(**names)}, tag)
    tree = '<root BTCPP_format="4"><BehaviorTree ID="M">\n<Go speed="1"/>\n</BehaviorTree></root>\n'
    found = compared(tmp_path, capsys, {"trees/m.xml": tree})
    assert change in {each["kind"] for each in found["changes"]}
    assert [(each["evidence"][0]["line"], what in each["message"]) for each in found["findings"]] == [(2, True)]


def test_trees_name_a_node_without_its_package(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a renamed package registers is called as it was."""
    source = TREES.format(name="Go", port="speed")
    gone: dict[str, str | None] = {}
    for tag, name in (("1.0.0", "cell"), ("2.0.0", "box")):
        files = {f"{name}/src/{each}.cpp": f"// {each}\n{source}" for each in ("go", "come", "wait")}
        files |= {f"{name}/package.xml": package(name, tag)}
        release(tmp_path / "cell", {**gone, **files}, tag)
        gone = dict.fromkeys(files)
    found = compared(tmp_path, capsys, {})
    assert {(each["kind"], each["breaking"]) for each in found["changes"]} == {("package", True)}


BASE = """#include <behaviortree_cpp/bt_factory.h>
class BasicAction : public BT::SyncActionNode {{
public:
  static BT::PortsList providedBasicPorts(BT::PortsList addition) {{
    BT::PortsList basic = {{BT::InputPort<double>("timeout"){port}}};
    return basic;
  }}
}};
class Wait : public BasicAction {{
public:
  static BT::PortsList providedPorts() {{ return providedBasicPorts({{}}); }}
}};
BT_REGISTER_NODES(factory) {{ factory.registerNodeType<Wait>("Wait"); }}
"""
DERIVED = """#include <behaviortree_cpp/bt_factory.h>
class Go : public BasicAction {{
public:
  static BT::PortsList providedPorts() {{ return providedBasicPorts({{{port}}}); }}
}};
BT_REGISTER_NODES(factory) {{ factory.registerNodeType<Go>("Go"); }}
"""


def test_a_port_that_a_base_of_another_package_has_now_is_there(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A release that lets the base class add a port takes it away from no node."""
    port = 'BT::OutputPort<int>("error_code_id")'
    for tag, base, derived in (("1.0.0", "", port), ("2.0.0", f", {port}", "")):
        files = {"base/package.xml": package("base"), "cell/package.xml": package("cell")}
        files |= {"base/src/b.cpp": BASE.format(port=base), "cell/src/c.cpp": DERIVED.format(port=derived)}
        release(tmp_path / "cell", dict(files), tag)
    assert told(compared(tmp_path, capsys, {})) == {("bt_port", "added", None, "error_code_id", False)}
