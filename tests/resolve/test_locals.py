"""A local belongs to its function."""

from __future__ import annotations

from typing import Any

CPP = """
class Demo : public rclcpp::Node {
 public:
  Demo() : Node("demo") { left(); right(); unknown(); }
  void left() { std::string topic_name = "left"; create_publisher<std_msgs::msg::Bool>(topic_name, 1); }
  void right() { std::string topic_name = "right"; create_publisher<std_msgs::msg::Bool>(topic_name, 1); }
  void unknown() { create_publisher<std_msgs::msg::Bool>(topic_name, 1); }
};
"""
PYTHON = """
from rclpy.node import Node
from std_msgs.msg import Bool
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.left()
        self.right()
        self.unknown()
    def left(self):
        topic_name = 'left'
        self.create_publisher(Bool, topic_name, 1)
    def right(self):
        topic_name = 'right'
        self.create_publisher(Bool, topic_name, 1)
    def unknown(self):
        self.create_publisher(Bool, topic_name, 1)
"""


def names(workspace: Any) -> set[str]:
    """Names of everything that is published."""
    return {entry.name for entry in workspace.interfaces() if entry.role == "publisher"}


def test_a_local_of_another_function_has_no_value_here(workspace: Any) -> None:
    """Two functions have a local of one name each; a third that has none gets neither (R7)."""
    assert names(workspace.package({"src/demo.cpp": CPP})) == {"/left", "/right", "/{topic_name}"}


def test_a_local_of_another_function_has_no_value_here_in_python(workspace: Any) -> None:
    """The same in Python (R7)."""
    assert names(workspace.package({"pkg/demo.py": PYTHON})) == {"/left", "/right", "/{topic_name}"}
