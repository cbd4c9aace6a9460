"""What a program does with the object of a node that it makes is that node's."""

from __future__ import annotations

from typing import Any

SOURCE = """
#include <rclcpp/rclcpp.hpp>
class N : public rclcpp::Node {
public:
  N(const std::string & name) : Node(name) { declare_parameter("own", 1); }
};
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<N>("driver");
  if (node->declare_parameter<bool>("autostart", true)) { node->start(); }
  rclcpp::spin(node);
}
"""
BUILD = """
cmake_minimum_required(VERSION 3.8)
project(pkg)
find_package(ament_cmake REQUIRED)
add_executable(driver_main src/n.cpp)
install(TARGETS driver_main DESTINATION lib/${PROJECT_NAME})
ament_package()
"""


def test_a_program_that_calls_its_node_declares_for_that(workspace: Any) -> None:
    """It was told of a second module of the program, which is no node."""
    modules = workspace.package({"src/n.cpp": SOURCE, "CMakeLists.txt": BUILD}).modules()
    told = {name: sorted(one.name for one in each.signature.interfaces) for name, each in modules.items()}
    assert told == {"ecm.pkg.driver": ["autostart", "own"]}
