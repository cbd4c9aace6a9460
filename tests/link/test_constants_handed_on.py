"""Constants of C++ that functions and lambdas hand on: nobody who gets one can change it."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/bool.hpp>
class Ears : public rclcpp::Node {{
public:
  Ears() : Node("ears") {{
    std::vector<std::string> topics;
    topics.push_back("/a"); topics.push_back("/b");
    for ({each} : topics) {{ {body} }}
  }}
  void heard(const std::string & topic);
  void filled(std::string & topic);
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<Ears>()); }}
"""
MADE = "create_subscription<std_msgs::msg::Bool>(topic, 1, {heard});"
CONST = "const std::string & topic"
LAMBDA = MADE.format(heard="[this, topic](const std_msgs::msg::Bool & m) { this->heard(topic); }")
BOTH = {"/a": "folded", "/b": "folded"}
ROWS = [
    ("by a call", CONST, f"heard(topic); {MADE.format(heard='other')}", BOTH),
    ("by a lambda", CONST, LAMBDA, BOTH),
    ("by a lambda that stands before", CONST, "auto read = [this, topic](M & m) { heard(topic); };" + MADE, BOTH),
    ("what is no constant", "std::string & topic", f"filled(topic); {MADE}", {"/a": "one_of", "/b": "one_of"}),
    ("a lambda that has what is no constant", "std::string & topic", LAMBDA, {"/{topic}": "pattern"}),
]  # fmt: skip


@pytest.mark.parametrize(("each", "body", "names"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_constant_that_is_handed_on_stays_what_it_is(
    workspace: Any, each: str, body: str, names: dict[str, str]
) -> None:
    """Names that a loop gives were open where its lambda handed them to a method without a body."""
    text = CPP.format(each=each, body=body.replace("{heard}", "read"))
    found = workspace.package({"src/ears.cpp": text}).interfaces()
    assert {row.name: row.confidence for row in found if row.role == "subscriber"} == names
