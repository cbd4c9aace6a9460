"""Names that come from fields of plain structures: from what the object is made, else they are not told."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
#include <ros/ros.h>
struct Row {{ std::string label; std::string path = ""; }};
ros::NodeHandle * base;
std::map<std::string, Row> rows{{{{"left", {{"Left", "left_arm"}}}}, {{"right", {{"Right", "right_arm"}}}}}};
void limit(const Row & row) {{ base->param(row.path + "/max", 7); }}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  base = new ros::NodeHandle("/arms");
  {body}
}}
"""
BODIES = [
    ('Row row{"Left", "left_arm"}; limit(row);', ["/arms/left_arm/max"]),
    ('Row row{"Left"}; limit(row);', ["/max"]),
    ("Row row; limit(row);", ["/max"]),
    ("Row row = outside(); limit(row);", ["/arms/{row}/max"]),
    ("for (const auto & pair : rows) { limit(pair.second); }", ["/arms/left_arm/max", "/arms/right_arm/max"]),
    (
        'for (const auto & pair : rows) { base->param(pair.first + "/max", 7); }',
        ["/arms/left/max", "/arms/right/max", "/arms/{row}/max"],
    ),
    ("std::function<void(const Row &)> call = &limit;", ["/arms/{row}/max"]),
    (
        'std::map<std::string, Row> one{{"up", {"Up", "up_arm"}}}; for (auto & pair : one) { limit(pair.second); }',
        ["/arms/up_arm/max"],
    ),
    ("for (const Row & row : outside()) { limit(row); }", ["/arms/{row}/max"]),
]


@pytest.mark.parametrize(("body", "names"), BODIES, ids=[row[0][:50] for row in BODIES])
def test_a_field_is_what_its_object_was_made_with(workspace: Any, body: str, names: list[str]) -> None:
    """The default that a structure declares is told of an object that is surely as declared, and of no other."""
    found = workspace.package({"src/demo.cpp": SOURCE.format(body=body)}, 1).interfaces()
    assert sorted({entry.name for entry in found if entry.role == "parameter"}) == names


LISTED = """
#include <rclcpp/rclcpp.hpp>
class Wrapped {{
 public:
  rclcpp::ParameterType kind;
  std::string title;
  Wrapped(std::string name, int & out, int value = 0)
    : kind{{rclcpp::ParameterType::PARAMETER_INTEGER}}, title{{std::move(name)}} {{}}
  Wrapped(std::string name, std::string & out, std::string value = "")
    : kind{{rclcpp::ParameterType::PARAMETER_STRING}}, title{{std::move(name)}} {{}}
  static void declare_all(rclcpp::Node * node, std::vector<Wrapped> & wrapped) {{
    for (auto & each : wrapped) {{ node->declare_parameter(each.title, each.kind); }}
  }}
}};
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{
    std::string port;
    {body}
  }}
  int baud_;
}};
"""
LISTS = [
    (
        'std::vector<Wrapped> all{{"port", port, "/dev/a"}, {"baud", baud_, 9600}}; Wrapped::declare_all(this, all);',
        [("baud", "integer"), ("port", "string")],
    ),
    ('std::vector<Wrapped> all = {{"port", port, "/dev/a"}}; Wrapped::declare_all(this, all);', [("port", "string")]),
    ("std::vector<Wrapped> all = outside(); Wrapped::declare_all(this, all);", [("{all}", None)]),
]


@pytest.mark.parametrize(("body", "told"), LISTS, ids=[row[0][:40] for row in LISTS])
def test_a_member_of_a_listed_object_is_what_its_constructor_gives_it(
    workspace: Any, body: str, told: list[tuple[str, str | None]]
) -> None:
    """The constructor that takes the values in the braces best gives the members; of an unknown list nothing is told."""
    found = workspace.package({"src/demo.cpp": LISTED.format(body=body)}).interfaces()
    assert sorted((entry.name, entry.type) for entry in found if entry.role == "parameter") == told


HELD = """
#include <rclcpp/rclcpp.hpp>
struct Options {{ std::string topic = "scan"; }};
class Demo : public rclcpp::Node {{
 public:
  explicit Demo(const Options & options) : Node("demo"){begun} {{
    {body}
    timer_ = create_wall_timer(1s, std::bind(&Demo::tick, this));
  }}
  void tick() {{ publisher_ = create_publisher<std_msgs::msg::String>(options_.topic, 1); }}
  Options options_;
}};
"""
MEMBERS = [
    ("", "", "/scan", "folded"),
    (", options_(options)", "", "/{options}", "pattern"),
    (", options_(outside())", "", "/{options}", "pattern"),
    ("", "options_ = outside();", "/{options}", "pattern"),
    ("", 'options_ = Options{"map"};', "/map", "folded"),
]


@pytest.mark.parametrize(
    ("begun", "body", "name", "confidence"), MEMBERS, ids=[f"{row[0]} {row[1]}" for row in MEMBERS]
)
def test_a_member_that_another_method_gives_an_object_is_not_as_its_class_declares_it(
    workspace: Any, begun: str, body: str, name: str, confidence: str
) -> None:
    """A callback reads a structure that the constructor was given: the defaults of its class say nothing of it."""
    found = workspace.package({"src/demo.cpp": HELD.format(begun=begun, body=body)}).interfaces()
    assert [(entry.name, entry.confidence) for entry in found if entry.role == "publisher"] == [(name, confidence)]
