"""Parameters whose names others give: they are called what these are by default, wherever those are read."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <rclcpp/rclcpp.hpp>
class Arm : public rclcpp::Node {{
public:
  Arm() : Node("arm") {{
    {read}
    {named}
  }}
  std::vector<std::string> joints_;
  std::string prefix_;
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<Arm>()); }}
"""
JOINTS = 'declare_parameter("joints", std::vector<std::string>{"a", "b"}); '
EACH = 'for (const auto & joint : joints_) declare_parameter("gain." + joint, 1.0);'
PREFIX = 'declare_parameter("prefix", "left"); '
ONE = 'declare_parameter(prefix_ + ".gain", 1.0);'
LIST = {"joints": "literal", "gain.a": "default", "gain.b": "default"}
TEXT = {"prefix": "literal", "left.gain": "default"}
ROWS = [
    ("a list, read into", JOINTS + 'get_parameter("joints", joints_);', EACH, LIST),
    ("a list by value", JOINTS + 'joints_ = get_parameter("joints").as_string_array();', EACH, LIST),
    ("a text, read into", PREFIX + 'get_parameter("prefix", prefix_);', ONE, TEXT),
    ("a text by value", PREFIX + 'prefix_ = get_parameter("prefix").as_string();', ONE, TEXT),
    ("a text that nobody knows", "prefix_ = other();", ONE, {"{other}.gain": "pattern"}),
]


@pytest.mark.parametrize(("read", "named", "names"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_parameter_is_called_what_another_is_by_default(
    workspace: Any, read: str, named: str, names: dict[str, str]
) -> None:
    """Names were found before the defaults of other parameters were known, and stayed patterns."""
    found = workspace.package({"src/arm.cpp": CPP.format(read=read, named=named)}).interfaces()
    assert {row.name: row.confidence for row in found if row.role == "parameter"} == names


PYTHON = """
import rclpy
from rclpy.node import Node
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.declare_parameter('prefix', 'left')
        self.declare_parameter('joints', ['a', 'b'])
        prefix = self.get_parameter('prefix').value
        for joint in self.get_parameter('joints').value:
            self.declare_parameter(f'{prefix}.{joint}.gain', 2.5)
        gain = self.get_parameter('left.a.gain').value
        self.create_publisher(String, f'gain_{gain}', 1)
def main():
    rclpy.init()
    rclpy.spin(Arm())
"""


def test_python_too_and_their_own_defaults_are_known(workspace: Any) -> None:
    """What is named so has a default as well, of which other names are made."""
    found = workspace.package({"pkg/arm.py": PYTHON}).interfaces()
    assert {"left.a.gain", "left.b.gain"} <= {row.name for row in found if row.role == "parameter"}
    assert {row.name for row in found if row.role == "publisher"} == {"/gain_2.5"}
