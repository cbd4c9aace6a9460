"""Structures of settings that parameters are read into: by the function at hand, by others, by methods of their own."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct Settings {{
  std::string topic = "begun";
  int depth = 3;
  void load(rclcpp::Node * node) {{ node->get_parameter("topic", topic); node->get_parameter("depth", depth); }}
  void load_all(rclcpp::Node * node) {{ load(node); }}
  void name(rclcpp::Node * node) {{ node->declare_parameter(topic + ".name", 1); }}
}};
void load_into(rclcpp::Node & node, Settings & settings) {{
  node.get_parameter("topic", settings.topic); node.get_parameter("depth", settings.depth);
}}
Settings load_by(rclcpp::Node & node) {{
  Settings own; node.get_parameter("topic", own.topic); node.get_parameter("depth", own.depth); return own;
}}
class Loader {{ public: Loader(rclcpp::Node & node, Settings & settings) {{ load_into(node, settings); }} }};
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo"){begun} {{
    declare_parameter("topic", "chatter"); declare_parameter("depth", 7);
    {body}
  }}
  Settings loaded() {{
    Settings own; own.topic = declare_parameter("topic", "chatter"); own.depth = declare_parameter("depth", 7); return own;
  }}
  void pub(const std::string & topic, int depth) {{ create_publisher<std_msgs::msg::String>(topic, depth); }}
  Settings member_;
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<Demo>()); }}
"""
TOLD = [
    ("here", 'Settings s; get_parameter("topic", s.topic); get_parameter("depth", s.depth); pub(s.topic, s.depth);'),
    ("returned", "auto s = load_by(*this); pub(s.topic, s.depth);"),
    ("by a method that returns it", "auto s = loaded(); pub(s.topic, s.depth);"),
    ("returned into a member", "member_ = loaded(); pub(member_.topic, member_.depth);"),
    ("into a member", 'get_parameter("topic", member_.topic); get_parameter("depth", member_.depth); pub(member_.topic, member_.depth);'),
]  # fmt: skip
OPEN = [
    ("by reference", "Settings s; load_into(*this, s); pub(s.topic, s.depth);"),
    ("by a constructor", "Settings s; Loader loader(*this, s); pub(s.topic, s.depth);"),
    ("by its own method", "Settings s; s.load(this); pub(s.topic, s.depth);"),
    ("by a method of its own method", "Settings s; s.load_all(this); pub(s.topic, s.depth);"),
    ("behind a pointer", "auto s = std::make_shared<Settings>(); s->load(this); pub(s->topic, s->depth);"),
]


def _told(workspace: Any, body: str, begun: str = "") -> list[tuple[str, str, int | None]]:
    """Name, confidence and depth of the publishers."""
    package = workspace.package({"src/d.cpp": TEXT.format(body=body, begun=begun)})
    streams = [entry for entry in package.interfaces() if entry.role == "publisher"]
    return [(entry.name, entry.confidence, entry.qos.depth if entry.qos else None) for entry in streams]


@pytest.mark.parametrize("body", [row[1] for row in TOLD], ids=[row[0] for row in TOLD])
def test_fields_are_what_the_parameters_are_by_default(workspace: Any, body: str) -> None:
    """What the class declares a field with is gone once a parameter is read into it that has a default."""
    assert _told(workspace, body) == [("/chatter", "default", 7)]


def test_a_member_that_a_constructor_begins_with_what_a_method_returns(workspace: Any) -> None:
    """`Demo() : settings_(load())`."""
    found = _told(workspace, "pub(member_.topic, member_.depth);", begun=", member_(loaded())")
    assert found == [("/chatter", "default", 7)]


@pytest.mark.parametrize("body", [row[1] for row in OPEN], ids=[row[0] for row in OPEN])
def test_what_a_method_that_gets_the_node_reads_is_not_told_as_it_was(workspace: Any, body: str) -> None:
    """A call that is given the object at hand may change the object, too, that it is called on."""
    assert all(how not in {"folded", "literal"} and depth != 3 for _, how, depth in _told(workspace, body))


def test_a_method_that_only_asks_leaves_its_object_alone(workspace: Any) -> None:
    """It is given the node, and changes nothing of its own."""
    body = "Settings s; s.name(this); pub(s.topic, s.depth);"
    assert _told(workspace, body) == [("/begun", "folded", 3)]


ALIASED = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct Settings {{ std::string topic = "begun"; }};
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo"), qos_(3) {{
    settings_.topic = "own"; topic_ = "own";
    change();
    create_publisher<std_msgs::msg::String>({name}, qos_);
  }}
  void change() {{ {change} }}
  Settings settings_; std::string topic_; rclcpp::QoS qos_;
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<Demo>()); }}
"""
BY_OTHER_NAMES = [
    ("settings_.topic", 'auto & s = settings_; s.topic = "set";', "/set", "reliable"),
    ("topic_", 'auto & t = topic_; t = "set";', "/set", "reliable"),
    ("topic_", "auto & q = qos_; q.best_effort();", "/own", "best_effort"),
    ("settings_.topic", 'auto s = settings_; s.topic = "set";', "/own", "reliable"),
]


@pytest.mark.parametrize(("name", "change", "told", "reliability"), BY_OTHER_NAMES, ids=[r[1] for r in BY_OTHER_NAMES])
def test_what_a_method_changes_by_another_name(
    workspace: Any, name: str, change: str, told: str, reliability: str
) -> None:
    """A reference to a member is the member: what a method writes by it is the member's behind the call."""
    found = workspace.package({"src/d.cpp": ALIASED.format(name=name, change=change)}).only("publisher")
    assert (found.name, found.qos.reliability) == (told, reliability)


def test_what_a_method_of_python_changes_by_another_name(workspace: Any) -> None:
    """`s = self.settings` is the same object."""
    text = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Settings:
    def __init__(self):
        self.topic = 'begun'
class Demo(Node):
    def __init__(self):
        super().__init__('demo')
        self.settings = Settings()
        self.change()
        self.create_publisher(String, self.settings.topic, 1)
    def change(self):
        s = self.settings
        s.topic = 'set'
"""
    found = workspace.package({"pkg/d.py": text}).only("publisher")
    assert (found.name, found.confidence) == ("/set", "folded")


def test_a_depth_of_several_is_none(workspace: Any) -> None:
    """Nobody knows which of two lengths a queue has."""
    body = 'int depth = 1; if (get_parameter("deep").as_bool()) { depth = 9; } pub("a", depth);'
    assert [depth for _, _, depth in _told(workspace, body)] == [None]
