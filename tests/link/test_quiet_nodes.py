"""Programs that are nodes, though they have no endpoint and no parameter of their own."""

from __future__ import annotations

from typing import Any

import pytest

CMAKE = "add_executable(quiet src/d.cpp)"
ROS2 = "#include <rclcpp/rclcpp.hpp>\nint main() {{ rclcpp::init(0, nullptr); {} }}\n"
ROS1 = "#include <ros/ros.h>\nint main(int argc, char ** argv) {{ {} }}\n"
ROWS = [
    ("a node of the library", 2, ROS2.format('rclcpp::spin(rclcpp::Node::make_shared("demo"));'), ["node"]),
    ("no node", 2, ROS2.format("run();"), ["library"]),
    ("a node of ROS 1", 1, ROS1.format('ros::init(argc, argv, "demo"); ros::NodeHandle nh; ros::spin();'), ["node"]),
    ("no node of ROS 1", 1, ROS1.format("run();"), ["library"]),
]


@pytest.mark.parametrize(("ros", "source", "kinds"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_program_that_makes_a_node_is_one(workspace: Any, ros: int, source: str, kinds: list[str]) -> None:
    """Whoever starts it starts a node; a program that makes none is no module."""
    package = workspace.package({"src/d.cpp": source, "CMakeLists.txt": CMAKE}, ros=ros)
    assert [module.ecm.kind for module in package.modules().values()] == kinds
