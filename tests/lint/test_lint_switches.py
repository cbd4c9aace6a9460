"""A node that a parameter keeps from publishing is no writer where a launch file starts it so."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

CODE = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from geometry_msgs.msg import Twist
class A(Node):
    def __init__(self):
        super().__init__("a")
        self.declare_parameter("drives", False)
        if self.get_parameter("drives").value:
            self.create_publisher(Twist, "/cmd_vel", 1)
rclpy.init()
rclpy.spin(A())
"""


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [("", "", False), ("true", "", False), ("true", "true", True), ("true", "false", False)],
)
def test_several_writers(workspace: Workspace, first: str, second: str, expected: bool) -> None:
    """Only nodes whose parameter is set so publish; the default of the program counts where nothing is set."""
    nodes = "".join(_node(name, value) for name, value in (("a", first), ("b", second)))
    files = {
        "scripts/a": CODE,
        "CMakeLists.txt": "install(PROGRAMS scripts/a DESTINATION lib/pkg)\n",
        "launch/a.launch.xml": f"<launch>{nodes}</launch>",
    }
    rules = [finding.rule for finding in lint(workspace.package(files, ros=2).root)]
    assert ("LNT012" in rules) is expected


def _node(name: str, value: str) -> str:
    setting = f'<param name="drives" value="{value}"/>' if value else ""
    return f'<node pkg="pkg" exec="a" name="{name}">{setting}</node>'
