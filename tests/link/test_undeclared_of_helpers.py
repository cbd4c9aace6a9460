"""Parameters that a helper reads of a node which takes what it does not declare: whoever makes the node says so."""

from __future__ import annotations

from typing import Any

import pytest

SETTINGS = """
#include <rclcpp/rclcpp.hpp>
class Settings {
public:
  void load(const rclcpp::Node * node) {
    if (node->has_parameter("level")) node->get_parameter("level", level_);
  }
  int level_ = 0;
};
"""
CAMERA = """
#include "settings.hpp"
class Camera : public rclcpp::Node {
public:
  explicit Camera(const rclcpp::NodeOptions & options) : Node("camera", options) { settings_.load(this); }
  Settings settings_;
};
"""
MAIN = """
#include "camera.hpp"
int main(int argc, char ** argv) {{
  rclcpp::NodeOptions options;
  options.automatically_declare_parameters_from_overrides({says});
  rclcpp::spin(std::make_shared<Camera>(options));
}}
"""


@pytest.mark.parametrize(("says", "names"), [("true", {"level"}), ("false", set())])
def test_what_a_member_of_a_node_reads_is_a_parameter_where_the_node_takes_any(
    workspace: Any, says: str, names: set[str]
) -> None:
    """The helper is no node: the class that has it, or whoever makes that one, says what is taken."""
    files = {"src/settings.hpp": SETTINGS, "src/camera.hpp": CAMERA, "src/main.cpp": MAIN.format(says=says)}
    found = workspace.package(files).interfaces()
    assert {each.name for each in found if each.role == "parameter"} == names
