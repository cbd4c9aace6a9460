"""Calls on the way to a form are seen one state at a time, with what the outermost one hands in."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, String
class Part:
    def __init__(self, node, prefix):
        self.node = node
        for kind, label in ((String, 'text'), (Bool, 'flag')):
            self.open(kind, f'{prefix}/{label}')
    def open(self, kind, topic):
        self.node.create_publisher(kind, topic, 10)
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.part = Part(self, 'own')
def main():
    rclpy.init()
    rclpy.spin(Demo())
"""
CPP = """
class Part {
 public:
  Part(rclcpp::Node * node, const std::string & prefix) : node_(node) {
    std::vector<std::string> labels{"text", "flag"};
    for (const auto & label : labels) { open(prefix + "/" + label, label == "text" ? 1 : 2); }
  }
  void open(const std::string & topic, int depth) { node_->create_publisher<std_msgs::msg::String>(topic, depth); }
  rclcpp::Node * node_;
};
class Demo : public rclcpp::Node { public: Demo() : Node("demo"), part_(this, "own") {} Part part_; };
"""


def test_what_a_table_pairs_stays_together(workspace: Any) -> None:
    """The names of a table go with the types beside them, however many calls are between the table and the form."""
    workspace.package({"pkg/demo.py": PYTHON})
    assert [(one.name, one.type, one.confidence) for one in workspace.interfaces()] == [
        ("/own/flag", "std_msgs/msg/Bool", "folded"),
        ("/own/text", "std_msgs/msg/String", "folded"),
    ]


def test_each_round_of_a_loop_has_its_own_depth(workspace: Any) -> None:
    """What depends on the element of the round is that of the round."""
    workspace.package({"src/demo.cpp": CPP})
    assert [(one.name, one.qos.depth) for one in workspace.interfaces()] == [("/own/flag", 2), ("/own/text", 1)]


ASKED = """
void open(rclcpp::Node * node, const std::string & topic) { node->create_publisher<std_msgs::msg::String>(topic, 1); }
void perhaps(rclcpp::Node * node, bool wanted, const std::string & topic) {
  if (wanted) { open(node, topic + "/in"); }
}
int main(int argc, char ** argv) {
  auto node = rclcpp::Node::make_shared("demo");
  perhaps(node.get(), WANTED, "a");
}
"""


@pytest.mark.parametrize(("wanted", "found"), [("true", ["/a/in"]), ("false", []), ("argc > 1", ["/a/in"])])
def test_arguments_can_keep_a_call_between_from_being_reached(workspace: Any, wanted: str, found: list[str]) -> None:
    """What the outermost call hands in decides about calls between, too."""
    workspace.package({"src/demo.cpp": ASKED.replace("WANTED", wanted)})
    assert [one.name for one in workspace.interfaces()] == found


NESTED = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import Bool, String
class Demo(Node):
    def __init__(self, wheels):
        super().__init__('demo')
        last = 'first'
        for wheel in wheels:
            for kind, label in ((String, 'text'), (Bool, 'flag')):
                self.create_publisher(kind, f'{wheel}/{label}', 10)
            self.create_publisher(String, last, 10)
            last = 'next'
def main():
    rclpy.init()
    rclpy.spin(Demo(found()))
"""


def test_a_table_within_a_loop_over_what_is_not_known(workspace: Any) -> None:
    """Rounds of a loop over what is written out are told apart, though one around it stands for any number."""
    workspace.package({"pkg/demo.py": NESTED})
    assert [(one.name, one.type) for one in workspace.interfaces()] == [
        ("/first", "std_msgs/msg/String"),
        ("/next", "std_msgs/msg/String"),
        ("/{item}/flag", "std_msgs/msg/Bool"),
        ("/{item}/text", "std_msgs/msg/String"),
    ]
