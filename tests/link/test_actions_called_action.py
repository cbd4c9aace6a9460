"""Types of actions whose own name ends with `Action`."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
import rclpy
from rclpy.node import Node
from rclpy.action import ActionClient
from demo_msgs.action import {name}
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.client = ActionClient(self, {name}, "go")
"""
CPP = """
#include <rclcpp/rclcpp.hpp>
#include <rclcpp_action/rclcpp_action.hpp>
#include <demo_msgs/action/{name}.hpp>
class Demo : public rclcpp::Node {{
public:
  Demo() : Node("demo") {{ client_ = rclcpp_action::create_client<demo_msgs::action::{name}>(this, "go"); }}
  rclcpp_action::Client<demo_msgs::action::{name}>::SharedPtr client_;
}};
"""


@pytest.mark.parametrize("name", ["Go", "GoAction", "Action"])
@pytest.mark.parametrize(("path", "text"), [("pkg/demo.py", PYTHON), ("src/demo.cpp", CPP)], ids=["python", "cpp"])
def test_an_action_of_ros2_is_called_what_its_file_is_called(workspace: Any, path: str, text: str, name: str) -> None:
    """Only the messages that ROS 1 makes of `Go.action` add `Action` to its name."""
    found = workspace.package({path: text.format(name=name)}).only("action_client")
    assert found.type == f"demo_msgs/action/{name}"
