"""Elements of lists that parameters are: what they are as long as nobody sets the parameter."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class N : public rclcpp::Node {{
public:
  N() : Node("n") {{
    {setup}
    timer_ = create_wall_timer(std::chrono::seconds(1), [this]() {{ make(); }});
    sub_ = create_subscription<std_msgs::msg::Int8>("in", 1, [this](std_msgs::msg::Int8::SharedPtr m) {{ {change} }});
  }}
  void make() {{ {made} }}
  std::vector<std::string> topics_;
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<N>()); }}
"""
DECLARED = 'topics_ = declare_parameter<std::vector<std::string>>("topics", {"/a", "/b"});'
READ = 'declare_parameter("topics", std::vector<std::string>{"/a", "/b"}); get_parameter("topics", topics_);'
EACH = "for (const auto & t : topics_) out_ = create_publisher<std_msgs::msg::String>(t, 1);"
ONE = "out_ = create_publisher<std_msgs::msg::String>({}, 1);"
ROWS = [
    ("by index", DECLARED, "", ONE.format("topics_[0]"), {"/a": "default"}),
    ("at", DECLARED, "", ONE.format("topics_.at(1)"), {"/b": "default"}),
    ("beyond the default", DECLARED, "", ONE.format("topics_[2]"), {"/{item}": "pattern"}),
    ("any", DECLARED, "", ONE.format("topics_[which()]"), {"/{item}": "pattern"}),
    ("each of what is read", READ, "", EACH, {"/a": "default", "/b": "default"}),
    ("each, filled elsewhere", DECLARED, 'topics_.push_back("/c");', EACH, {"/{item}": "pattern"}),
    ("each, changed elsewhere", DECLARED, "topics_[0] = other();", EACH, {"/{item}": "pattern"}),
    ("one, changed elsewhere", DECLARED, "topics_[0] = other();", ONE.format("topics_[0]"), {"/{item}": "pattern"}),
    ("handed over before", READ + " fill(topics_);", "", EACH, {"/{item}": "pattern"}),
]
PYTHON = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class D(Node):
    def __init__(self):
        super().__init__('d')
        topics = self.declare_parameter('topics', ['/a', '/b']).{read}
        {made}
def main():
    rclpy.init()
    rclpy.spin(D())
"""
READS = ["value", "get_parameter_value().string_array_value"]


@pytest.mark.parametrize(("setup", "change", "made", "names"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_an_element_is_that_of_the_default_as_long_as_nobody_changes_the_list(
    workspace: Any, setup: str, change: str, made: str, names: dict[str, str]
) -> None:
    """`topics[0]` is the default's first element; callbacks that change the list leave elements that nobody knows."""
    found = workspace.package({"src/d.cpp": CPP.format(setup=setup, change=change, made=made)}).interfaces()
    assert {row.name: row.confidence for row in found if row.role == "publisher"} == names


@pytest.mark.parametrize("read", READS)
@pytest.mark.parametrize(("made", "names"), [("topics[-1]", {"/b"}), ("topics[0] + '/x'", {"/a/x"})])
def test_python_reads_a_list_by_value(workspace: Any, read: str, made: str, names: set[str]) -> None:
    """However the value is taken from the parameter, an index takes the default's element."""
    text = PYTHON.format(read=read, made=f"self.create_publisher(String, {made}, 1)")
    found = workspace.package({"pkg/d.py": text}).interfaces()
    assert {row.name for row in found if row.role == "publisher"} == names


@pytest.mark.parametrize("copied", ["list({})", "tuple({})", "{}"])
def test_a_copy_has_the_elements_of_the_default(workspace: Any, copied: str) -> None:
    """A loop over a copy that a member is has them as a loop over the list has."""
    made = f"self.names = {copied.format('topics')}\n"
    made += "        for name in self.names:\n            self.create_publisher(String, f'{name}/x', 1)"
    text = PYTHON.format(read="value", made=made)
    found = workspace.package({"pkg/d.py": text}).interfaces()
    names = {row.name: row.confidence for row in found if row.role == "publisher"}
    assert names == {"/a/x": "default", "/b/x": "default"}


def test_a_table_by_default_has_no_elements_by_index(workspace: Any) -> None:
    """A key that is not known takes a value of a table, not one of its keys."""
    text = "import rospy\nfrom std_msgs.msg import String\nrospy.init_node('d')\n"
    text += "rospy.Publisher(rospy.get_param('~t', {'a': '/x'})[which()], String, queue_size=1)\n"
    found = workspace.package({"scripts/d.py": text}, ros=1).only("publisher")
    assert found.confidence == "pattern"


def test_a_list_that_is_copied_of_itself_ends(workspace: Any) -> None:
    """Who asks what it is comes back to it: nothing is told of its elements."""
    made = "self.names = topics\n        for i in range(3):\n            self.names = list(self.names)\n"
    made += "        for name in self.names:\n            self.create_publisher(String, name, 1)"
    text = PYTHON.format(read="value", made=made)
    found = workspace.package({"pkg/d.py": text}).only("publisher")
    assert found.confidence == "pattern"


COUNTS = [
    ("range(count)", 2, {"/arm_0": "default", "/arm_{item}": "pattern"}),
    ("range(1, count + 1)", 2, {"/arm_1": "default", "/arm_{item}": "pattern"}),
    ("range(count)", 0, {"/arm_{item}": "pattern"}),
    ("range(other())", 2, {"/arm_{item}": "pattern"}),
]


@pytest.mark.parametrize(("counted", "default", "names"), COUNTS)
def test_the_first_of_a_count_that_a_parameter_is(
    workspace: Any, counted: str, default: int, names: dict[str, str]
) -> None:
    """`range(count)` begins with what it has by default; how many follow is what the parameter says."""
    made = f"for i in {counted}:\n            self.create_publisher(String, f'arm_{{i}}', 1)"
    text = PYTHON.format(read="value", made=made).replace("topics", "count").replace("['/a', '/b']", str(default))
    found = workspace.package({"pkg/d.py": text}).interfaces()
    assert {row.name: row.confidence for row in found if row.role == "publisher"} == names
