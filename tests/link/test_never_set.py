"""Private members that nobody gives anything: what they decide for ever, and who may still change them."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
void read_it(bool & flag);
class Demo : public rclcpp::Node {{
  {friend}
 public:
  Demo() : Node("demo"){begun} {{ {body} setup(); }}
  ~Demo() = default;
  Demo(const Demo &) = delete;
  {public}
 {access}:
  void setup() {{ if ({test}) pub_ = create_publisher<std_msgs::msg::String>("debug", 1); }}
  {type} debug_{declared};
  rclcpp::PublisherBase::SharedPtr pub_;
}};
{behind}
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<Demo>()); }}
"""
PLAIN = {
    "friend": "",
    "begun": "",
    "body": "",
    "public": "",
    "access": "private",
    "test": "debug_",
    "type": "bool",
    "declared": " = false",
    "behind": "",
}
NEVER = [
    {},
    {"begun": ", debug_(false)", "declared": ""},
    {"test": "this->debug_"},
    {"test": "debug_ && true"},
    {"type": "int", "declared": "{0}", "test": "debug_ > 2"},
    {"public": "bool asked() const { return !debug_; }"},
    {"public": "bool asked() const { return debug_; }"},
    {"behind": "struct Other { bool debug_ = false; void on() { debug_ = true; } };"},
    {"behind": "void on(Other & other) { other.debug_ = true; }\nstruct Other { bool debug_ = false; };"},
]
MAYBE = [
    {"declared": " = true"},
    {"declared": ""},
    {"access": "protected"},
    {"access": "public"},
    {"public": "void debug() { debug_ = true; }"},
    {"public": "void debug() { this->debug_ = true; }"},
    {"public": "void debug() { [this]() { debug_ = true; }(); }"},
    {"public": "void debug() { auto & flag = debug_; flag = true; }"},
    {"public": "struct Part { void on(Demo & demo) { demo.debug_ = true; } };"},
    {"public": "bool * debug() { return &debug_; }"},
    {"public": "bool & debug() { return debug_; }"},
    {"public": "void debug(std::istream & from) { from >> debug_; }"},
    {"public": "void debug();"},
    {"body": "read_it(debug_);"},
    {"body": "std::cin >> debug_;"},
    {"type": "int", "declared": " = 0", "test": "debug_ > 2", "public": "void more() { ++debug_; }"},
    {"friend": "friend class Maker;", "behind": "class Maker { void on(Demo * demo) { demo->debug_ = true; } };"},
    {"friend": "friend class Maker;", "behind": "class Maker { void on(Demo & demo) { read_it(demo.debug_); } };"},
    {"type": "std::atomic<bool>", "declared": "{false}", "body": "debug_.store(true);"},
]


def _is_told(workspace: Any, parts: dict[str, str]) -> bool:
    """Whether the publisher behind the member is told."""
    package = workspace.package({"src/d.cpp": TEXT.format(**{**PLAIN, **parts})})
    return "/debug" in {entry.name for entry in package.interfaces()}


@pytest.mark.parametrize("parts", NEVER, ids=str)
def test_what_such_a_member_keeps_off_is_not_told(workspace: Any, parts: dict[str, str]) -> None:
    """Nobody can meet `if (debug_)`."""
    assert not _is_told(workspace, parts)


@pytest.mark.parametrize("parts", MAYBE, ids=str)
def test_what_somebody_may_set_is_told(workspace: Any, parts: dict[str, str]) -> None:
    """A method, a friend or who has a way to the member may set it; one that others can name anybody."""
    assert _is_told(workspace, parts)
