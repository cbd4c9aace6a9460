"""Rounds that a parameter counts: the first is told where there is one by default."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class Arms : public rclcpp::Node {{
public:
  Arms() : Node("arms") {{
    {count}
    {loop}
  }}
  bool loaded(const std::string & name, int & value, int otherwise) {{
    declare_parameter(name, otherwise); get_parameter(name, value); return ready();
  }}
  int arms_;
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<Arms>()); }}
"""
DIRECT = 'arms_ = declare_parameter("arms", {});'
READ = 'int read; declare_parameter("arms", {}); if (get_parameter("arms", read)) arms_ = read;'
MADE = 'create_publisher<std_msgs::msg::String>("arm_" + std::to_string(i + 1), 1)'
FOR = f"for (int i = 0; i < arms_; i++) {{ {MADE}; }}"
BEFORE = f"int i = 0; for (; i < arms_; ++i) {{ use(i); }} {MADE};"
GROWN = 'std::string name = "arm"; for (int i = 0; i < arms_; ++i) {{ name += "s"; }} create_publisher<std_msgs::msg::String>(name, 1);'
OPEN = "arms_ = other();"
ROWS = [
    ("none", DIRECT.format(0), FOR, {"/arm_{i}": "pattern"}),
    ("none, read into", READ.format(0), FOR, {"/arm_{i}": "pattern"}),
    ("two", DIRECT.format(2), FOR, {"/arm_1": "one_of", "/arm_{i}": "pattern"}),
    ("two, read into", READ.format(2), FOR, {"/arm_1": "one_of", "/arm_{i}": "pattern"}),
    ("not known", OPEN, FOR, {"/arm_1": "one_of", "/arm_{i}": "pattern"}),
    ("after the loop", DIRECT.format(0), BEFORE, {"/arm_1": "one_of", "/arm_{i}": "pattern"}),
]


@pytest.mark.parametrize(("count", "loop", "names"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_the_first_round_is_told_where_there_is_one_by_default(
    workspace: Any, count: str, loop: str, names: dict[str, str]
) -> None:
    """Of a loop that has no round by default the first is one of those that a pattern stands for."""
    found = workspace.package({"src/arms.cpp": CPP.format(count=count, loop=loop)}).interfaces()
    assert {row.name: row.confidence for row in found if row.role == "publisher"} == names


def test_what_such_rounds_change_is_by_default_what_it_was(workspace: Any) -> None:
    """What a loop without rounds would add to stays a possible name."""
    found = workspace.package({"src/arms.cpp": CPP.format(count=DIRECT.format(0), loop=GROWN.format())}).interfaces()
    assert "/arm" in {row.name for row in found if row.role == "publisher"}


OUTCOMES = [
    ("declared before", 'declare_parameter("arms", 0); if (get_parameter("arms", read)) arms_ = read;', {"/arm_0": "default"}),
    ("asked later", 'declare_parameter("arms", 0); bool there = get_parameter("arms", read); if (there) arms_ = read;', {"/arm_0": "default"}),
    ("a fallback that is dead", 'declare_parameter("arms", 0); if (!get_parameter("arms", arms_)) arms_ = 7;', {"/arm_0": "default"}),
    ("with another one instead", 'declare_parameter("arms", 0); if (get_parameter_or("arms", read, 5)) arms_ = read;', {"/arm_0": "default"}),
    ("declared of another node", 'declare_parameter("arms", 0); if (other_->get_parameter("arms", read)) arms_ = read;', {"/arm_0": "one_of", "/arm_3": "one_of"}),
    ("declared where not all runs come", 'if (ready()) declare_parameter("arms", 0); if (get_parameter("arms", read)) arms_ = read;', {"/arm_0": "one_of", "/arm_3": "one_of"}),
    ("declared without a value", 'declare_parameter("arms", rclcpp::ParameterValue()); if (get_parameter("arms", read)) arms_ = read;', {"/arm_3": "one_of"}),
    ("an alternative to what is declared", 'declare_parameter("arms", 0); get_parameter_or("arms", arms_, 5);', {"/arm_0": "default"}),
    ("an alternative", 'get_parameter_or("arms", arms_, 5);', {"/arm_5": "default"}),
    ("a helper that says something else", 'if (!loaded("arms", read, 0)) arms_ = read;', {"/arm_0": "one_of", "/arm_3": "one_of"}),
    ("never declared", 'if (get_parameter("arms", read)) arms_ = read;', {"/arm_3": "one_of"}),
]  # fmt: skip
NAMED = 'create_publisher<std_msgs::msg::String>("arm_" + std::to_string(arms_), 1);'


@pytest.mark.parametrize(("count", "names"), [row[1:] for row in OUTCOMES], ids=[row[0] for row in OUTCOMES])
def test_a_call_that_reads_into_a_variable_tells_whether_there_was_a_value(
    workspace: Any, count: str, names: dict[str, str]
) -> None:
    """It was taken for the value, so that of a default of 0 what the other side of the test leaves was told."""
    text = CPP.format(count="int read; arms_ = 3; " + count, loop=NAMED)
    found = workspace.package({"src/arms.cpp": text}).interfaces()
    assert {row.name: row.confidence for row in found if row.role == "publisher"} == names
