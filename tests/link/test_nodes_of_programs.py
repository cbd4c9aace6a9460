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


LAMP = """
#include <rclcpp/rclcpp.hpp>
class Lamp : public rclcpp::Node {
public:
  Lamp() : Node("lamp") { declare_parameter("own", 1); }
};
"""
LAMP_MAIN = """
#include "lamp.hpp"
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<Lamp>());
}
"""
TOOL = """
#include <rclcpp/rclcpp.hpp>
int main(int argc, char ** argv) {
  rclcpp::init(argc, argv);
  auto node = std::make_shared<rclcpp::Node>("tool");
  node->declare_parameter("rate", 1);
}
"""
PROGRAMS = BUILD.replace(
    "add_executable(driver_main src/n.cpp)", "add_executable(lamp src/lamp.cpp)\nadd_executable(tool src/tool.cpp)"
)


def test_a_program_that_only_makes_a_node_is_no_module_beside_it(workspace: Any) -> None:
    """To ask what another program makes gave this one an empty module, and the class of its node another name."""
    files = {"src/lamp.hpp": LAMP, "src/lamp.cpp": LAMP_MAIN, "src/tool.cpp": TOOL, "CMakeLists.txt": PROGRAMS}
    modules = workspace.package(files).modules()
    told = {name: [one.name for one in each.signature.interfaces] for name, each in modules.items()}
    assert told == {"ecm.pkg.lamp": ["own"], "ecm.pkg.tool": ["rate"]}
