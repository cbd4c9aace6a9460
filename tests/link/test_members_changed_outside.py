"""Members of a node that functions change which have its object, before one of its methods asks for them."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
std::string given();
void fill(std::vector<std::string> & out) {{ out.push_back(given()); }}
class N : public rclcpp::Node {{
public:
  N() : Node("n") {{ text_ = "a"; timer_ = create_wall_timer(1s, [this]() {{ tick(); }}); }}
  void tick() {{
    for (const auto & each : list_) {{ create_publisher<std_msgs::msg::String>(each, 10); }}
    create_subscription<std_msgs::msg::String>(text_, 10, call);
  }}
  std::vector<std::string> list_{{"a"}};
  std::string text_;
}};
int main(int argc, char ** argv) {{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<N>();
  {change}
  rclcpp::spin(node);
}}
"""
PYTHON = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from other import given

class N(Node):
    def __init__(self):
        super().__init__("n")
        self.list = ["a"]
        self.text = "a"
        self.create_timer(1.0, self.tick)

    def tick(self):
        for each in self.list:
            self.create_publisher(String, each, 10)
        self.create_subscription(String, self.text, print, 10)

def fill(out):
    out.append(given())

def main():
    rclpy.init()
    node = N()
    {change}
    rclpy.spin(node)
"""


def sure(workspace: Any, source: str) -> set[str]:
    found = workspace.package({"src/n.cpp" if "#include" in source else "pkg/n.py": source}).interfaces()
    return {one.role for one in found if one.confidence in {"literal", "folded"} and one.name == "/a"}


LIST, TEXT = "publisher", "subscriber"


@pytest.mark.parametrize(
    ("change", "changed"),
    [
        ("", None),
        ("auto local = node->list_; local.clear();", None),
        ('node->list_.push_back("b");', LIST),
        ("auto & list = node->list_; list.clear();", LIST),
        ("auto * list = &node->list_; list->clear();", LIST),
        ("fill(node->list_);", LIST),
        ("node->text_ = given();", TEXT),
        ('node->text_.append("b");', TEXT),
    ],
)
def test_a_member_of_a_node_in_cpp(workspace: Any, change: str, changed: str | None) -> None:
    """What methods show is one of several values, or none, where a program changes its node."""
    assert sure(workspace, CPP.format(change=change)) == {LIST, TEXT} - {changed}


@pytest.mark.parametrize(
    ("change", "changed"),
    [
        ("pass", None),
        ("other = given(); other.list = []", None),
        ('node.list.append("b")', LIST),
        ("node.list[0] = given()", LIST),
        ("node.list = given()", LIST),
        ("fill(node.list)", LIST),
        ("node.text = given()", TEXT),
    ],
)
def test_a_member_of_a_node_in_python(workspace: Any, change: str, changed: str | None) -> None:
    """So it is in Python: it was told as proved."""
    assert sure(workspace, PYTHON.format(change=change)) == {LIST, TEXT} - {changed}


SPINNING = """
#include <ros/ros.h>
class Demo {{
 public:
  explicit Demo(ros::NodeHandle & nh) : nh_(nh) {{ sub_ = nh.subscribe("in", 1, &Demo::on, this); }}
  void on(const std_msgs::String & message) {{ names_.push_back(message.data); }}
  void once() {{ if (!names_.empty()) pub_ = nh_.advertise<std_msgs::String>("out", 1); }}
  ros::NodeHandle & nh_;
  ros::Subscriber sub_;
  ros::Publisher pub_;
  std::vector<std::string> names_;
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  Demo demo(nh);
  {spinning}
}}
"""
WAYS = [
    (
        "threads run callbacks",
        "ros::AsyncSpinner spinner(2); spinner.start(); while (ros::ok()) demo.once();",
        {"/out"},
    ),
    ("none run before the program waits", "demo.once(); ros::spin();", set()),
]


@pytest.mark.parametrize(("spinning", "expected"), [row[1:] for row in WAYS], ids=[row[0] for row in WAYS])
def test_what_callbacks_of_other_threads_fill(workspace: Any, spinning: str, expected: set[str]) -> None:
    """A list that a callback fills is not told as empty once threads run callbacks."""
    files = {
        "CMakeLists.txt": "project(pkg)\nadd_executable(demo src/demo.cpp)\n",
        "src/demo.cpp": SPINNING.format(spinning=spinning),
    }
    found = workspace.package(files, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == "publisher"} == expected
