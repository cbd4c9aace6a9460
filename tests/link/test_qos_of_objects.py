"""A profile that another object keeps is what its class makes of it, or what it is where the object is handed on."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, qos_profile_sensor_data
from std_msgs.msg import String
class Part:
    def __init__(self, node):
        node.create_publisher(String, 'chatter', node.kept)
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.kept = qos_profile_sensor_data
        {before}
        self.part = Part(self)
        {after}
def main():
    rclpy.init()
    rclpy.spin(Demo())
"""
SENSOR, ONE, OPEN = ("best_effort", 5), ("reliable", 1), ("unknown", None)


@pytest.mark.parametrize(
    ("before", "after", "expected"),
    [
        ("pass", "pass", SENSOR),
        ("self.kept = QoSProfile(depth=1)", "pass", ONE),
        ("pass", "self.kept = QoSProfile(depth=1)", SENSOR),
        ("self.kept = found()", "pass", OPEN),
    ],
)
def test_a_profile_of_a_node_that_is_handed_on(
    workspace: Any, before: str, after: str, expected: tuple[str, int | None]
) -> None:
    """A part of a node makes its endpoints with the profile that the node has when it makes the part."""
    workspace.package({"pkg/demo.py": PYTHON.format(before=before, after=after)})
    qos = workspace.only("publisher").qos
    assert (qos.reliability, qos.depth) == expected


CPP = """
#include <rclcpp/rclcpp.hpp>
struct Settings {{
  rclcpp::QoS kept = rclcpp::QoS(1).best_effort();
}};
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{ {body} }}
  void open() {{ create_publisher<std_msgs::msg::String>("chatter", settings_.kept); }}
  Settings settings_;
}};
int main(int argc, char ** argv) {{ rclcpp::spin(std::make_shared<Demo>()); }}
"""


@pytest.mark.parametrize(
    ("body", "expected"), [("open();", ("best_effort", 1)), ("settings_.kept = found(); open();", OPEN)]
)
def test_a_profile_in_settings(workspace: Any, body: str, expected: tuple[str, int | None]) -> None:
    """Settings that nobody changes are as they are declared; of others nothing is known."""
    qos = workspace.package({"src/demo.cpp": CPP.format(body=body)}).only("publisher").qos
    assert (qos.reliability, qos.depth) == expected
