"""Objects that lead to objects of their own kind are followed a few steps, and the answer comes."""

from __future__ import annotations

from typing import Any

STEPS = 18
PROGRAM = """
#include <rclcpp/rclcpp.hpp>
struct Part {{ Part * parent; std::string name; }};
class D : public rclcpp::Node {{
public:
  D() : Node("d") {{}}
  void begin(Part * start) {{
    auto a = create_publisher<std_msgs::msg::String>(start{chain}->name, 1);
  }}
}};
int main(int argc, char ** argv) {{
  auto node = std::make_shared<D>();
  Part root{{nullptr, "root"}};
  Part leaf{{&root, "leaf"}};
  node->begin(&leaf);
  rclcpp::spin(node);
}}
"""


def test_a_long_chain_is_open(workspace: Any) -> None:
    """Each step asked for the ones before it on several ways: that once took more time than anybody has."""
    text = PROGRAM.format(chain="->parent" * STEPS)
    assert workspace.package({"src/d.cpp": text}).only("publisher").confidence == "pattern"
