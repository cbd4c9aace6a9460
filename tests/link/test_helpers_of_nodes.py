"""Objects that have the object of a node and change its members: `helper_(this)`, `self.helper = Helper(self)`."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Helper:
    def __init__(self, node):
        self.node = node

    def fill(self):
        self.node.topic = "set"

    def ask(self):
        self.node.rename("set")


class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.topic = "own"
        {begin}
        self.create_publisher(String, self.topic, 10)

    def prepare(self):
        self.helper.fill()

    def rename(self, name):
        self.topic = name


def main():
    rclpy.init()
    rclpy.spin(Demo())
"""
CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Demo;
struct Helper { Demo * node; explicit Helper(Demo * n) : node(n) {} void fill(); void ask(); };
class Demo : public rclcpp::Node {
public:
  Demo() : Node("demo"), helper_(this) {
    topic_ = "own";
    BEGIN;
    create_publisher<std_msgs::msg::String>(topic_, 10);
  }
  void prepare() { helper_.fill(); }
  void rename(const std::string & name) { topic_ = name; }
  std::string topic_;
  Helper helper_;
};
void Helper::fill() { node->topic_ = "set"; }
void Helper::ask() { node->rename("set"); }
int main() { auto node = std::make_shared<Demo>(); }
"""
OF_PYTHON = [
    "self.helper = Helper(self); self.helper.fill()",
    "helper = Helper(self); helper.fill()",
    "self.helper = Helper(self); self.prepare()",
    "self.helper = Helper(node=self); self.helper.ask()",
    "put = lambda key, value: setattr(self, key, value); put('topic', 'set')",
]
OF_CPP = ["helper_.fill()", "prepare()", "helper_.ask()", "Helper other(this); other.fill()"]


@pytest.mark.parametrize("begin", OF_PYTHON)
def test_what_a_helper_changes_in_python(workspace: Any, begin: str) -> None:
    """The member is not told as it was before the call."""
    package = workspace.package({"pkg/d.py": PYTHON.replace("{begin}", begin)})
    assert _confidences(package) <= {"one_of", "pattern"}


@pytest.mark.parametrize("begin", OF_CPP)
def test_what_a_helper_changes(workspace: Any, begin: str) -> None:
    """The member is not told as it was before the call."""
    package = workspace.package({"src/d.cpp": CPP.replace("BEGIN", begin)})
    assert _confidences(package) <= {"one_of", "pattern"}


def test_what_no_helper_changes_is_told(workspace: Any) -> None:
    """A helper that only looks leaves the member as it is."""
    source = PYTHON.replace('self.node.topic = "set"', "print(self.node.topic)").replace("{begin}", OF_PYTHON[0])
    package = workspace.package({"pkg/d.py": source.replace('self.node.rename("set")', "pass")})
    assert package.only("publisher").confidence == "folded"


def _confidences(package: Any) -> set[str]:
    return {entry.confidence for entry in package.interfaces() if entry.role == "publisher"}
