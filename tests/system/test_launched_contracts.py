"""`ecm-extract check --launch`: what a launch file composes, under the names that it gives."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from workspaces import Workspace

from ecm_extract.cli.run import run

SPAWN = """
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([
        Node(package='controller_manager', executable='ros2_control_node', parameters=[get_package_share_directory('pkg') + '/config/arm.yaml']),
        Node(package='controller_manager', executable='spawner', arguments=['arm_position']),
        Node(package='controller_manager', executable='spawner', arguments=['arm_other'{how}]),
    ])
"""
CONTROLLERS = """
controller_manager:
  ros__parameters:
    arm_position: {type: forward_command_controller/ForwardCommandController}
    arm_other: {type: forward_command_controller/ForwardCommandController}
arm_position:
  ros__parameters: {joints: [shoulder, elbow], interface_name: position}
arm_other:
  ros__parameters: {joints: [elbow], interface_name: position}
"""
TALK = """import rclpy
from rclpy.node import Node
from std_msgs.msg import {kind}
class N(Node):
    def __init__(self):
        super().__init__('{name}')
        self.{call}
def main():
    rclpy.spin(N())
"""
RUN = """
from launch import LaunchDescription
from launch_ros.actions import Node
def generate_launch_description():
    return LaunchDescription([
        Node(package='pkg', executable='out', remappings=[('state', 'arm/state')]),
        Node(package='pkg', executable='view', namespace='arm'),
    ])
"""
SETUP = """from setuptools import setup
setup(name='pkg', entry_points={'console_scripts': ['out = pkg.out:main', 'view = pkg.view:main']})
"""


def findings(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[tuple[str, str, list[str]]]:
    run(["check", *arguments, "--format", "json"])
    found = json.loads(capsys.readouterr().out)["findings"]
    return [(entry["rule"], entry["severity"], entry["subjects"]) for entry in found if entry["severity"] != "info"]


@pytest.mark.parametrize(("how", "conflict"), [("", True), (", '--inactive'", False)], ids=["active", "inactive"])
def test_controllers_that_a_launch_activates_together_must_not_claim_one_joint(
    tmp_path: Path, workspace: Any, capsys: pytest.CaptureFixture[str], how: str, conflict: bool
) -> None:
    workspace.package({"launch/arm.launch.py": SPAWN.replace("{how}", how), "config/arm.yaml": CONTROLLERS})
    found = findings(capsys, str(tmp_path), "--launch", "pkg/launch/arm.launch.py")
    subjects = ["/arm_other", "/arm_position"]
    assert found == ([("RES001", "error", subjects)] if conflict else [])


def test_names_are_those_of_the_launch(
    tmp_path: Path, workspace: Workspace, capsys: pytest.CaptureFixture[str]
) -> None:
    """A remap and a namespace bring a publisher and a subscriber of different types together."""
    out = TALK.format(kind="String", name="out", call="create_publisher(String, 'state', 10)")
    view = TALK.format(kind="Bool", name="view", call="create_subscription(Bool, 'state', print, 10)")
    files = {
        "pkg/__init__.py": "",
        "pkg/out.py": out,
        "pkg/view.py": view,
        "setup.py": SETUP,
        "launch/x.launch.py": RUN,
    }
    workspace.package(files)
    found = findings(capsys, str(tmp_path), "--launch", "pkg/x.launch.py")
    assert found == [("SIG001", "error", ["/out", "/arm/view"])]


def test_a_launch_goes_with_one_workspace(tmp_path: Path, workspace: Workspace) -> None:
    workspace.package({"launch/x.launch.py": RUN})
    assert run(["check", str(tmp_path), str(tmp_path), "--launch", "pkg/x.launch.py"]) == 2
    assert run(["check", "chain", str(tmp_path), "--launch", "pkg/x.launch.py"]) == 2
