"""What a constructor hands to that of its base is what the base has, whatever that has by default."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

class Base : public rclcpp::Node {{
  public:
    explicit Base(const std::string & name, const std::string & prefix = "goal") : Node(name), base_(prefix) {{}}
  protected:
    std::string base_;
}};

class Demo : public Base {{
  public:
    {constructors}
    void start() {{
      {body}
    }}
}};

int main() {{
  Demo node("demo");
  node.start();
}}
"""
ONE = 'explicit Demo(const std::string & name) : Base(name, "scan") {}'
TWO = f'Demo() : Base("demo", "other") {{}} {ONE}'
MAKE = "create_publisher<std_msgs::msg::String>(base_, 10);"
ROWS = [
    ("left alone", ONE, MAKE, "folded"),
    ("handed to others later", ONE, f"{MAKE} use(base_);", "folded"),
    ("handed to others before", ONE, f"use(base_); {MAKE}", "one_of"),
    ("by one of two constructors", TWO, MAKE, "folded"),
    ("by one of two, handed to others before", TWO, f"use(base_); {MAKE}", "one_of"),
]


@pytest.mark.parametrize(
    ("constructors", "body", "confidence"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS]
)
def test_a_member_of_a_base_is_what_its_derived_class_hands_over(
    workspace: Any, constructors: str, body: str, confidence: str
) -> None:
    """The default of the base's constructor, and what another constructor hands over, are stale."""
    text = NODE.format(constructors=constructors, body=body)
    found = workspace.package({"src/d.cpp": text, "CMakeLists.txt": "add_executable(d src/d.cpp)"}).only("publisher")
    assert (found.name, found.confidence) == ("/scan", confidence)
