"""Reads of parameters that give a text: what they give of a parameter that is declared with a number."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
class Demo : public rclcpp::Node {{ Demo() : Node("demo") {{
  declare_parameter("id", {default});
  create_publisher<std_msgs::msg::String>("/r" + get_parameter("id").as_string() + "/a", 1);
}} }};
"""
PYTHON = """
from rclpy.node import Node
from std_msgs.msg import String
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.declare_parameter('id', {default})
        value = self.get_parameter('id').{read}
        self.create_publisher(String, f'/r{{value}}/a', 1)
"""
ROWS = [
    ({"src/d.cpp": CPP.format(default="0")}, "/r{id}/a"),
    ({"src/d.cpp": CPP.format(default='"x"')}, "/rx/a"),
    ({"pkg/d.py": PYTHON.format(default="3", read="get_parameter_value().string_value")}, "/r{id}/a"),
    ({"pkg/d.py": PYTHON.format(default="'x'", read="get_parameter_value().string_value")}, "/rx/a"),
    ({"pkg/d.py": PYTHON.format(default="3", read="value")}, "/r3/a"),
]


@pytest.mark.parametrize(("files", "name"), ROWS, ids=[row[1] for row in ROWS])
def test_a_number_is_no_text(workspace: Any, files: dict[str, str], name: str) -> None:
    """`as_string` of a number raises and `string_value` is empty: the default is in no name that a run has."""
    assert workspace.package(files).only("publisher").name == name
