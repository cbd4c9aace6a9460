"""Explicit specializations of templates: which of them a call means, and what its arguments make of a template."""

from __future__ import annotations

from typing import Any

import pytest

BY_SIGNATURE = """
#include <rclcpp/rclcpp.hpp>
namespace util {{
using Node = rclcpp::Node;
template<typename T> std::optional<T> get(Node * node, const std::string & name);
template<typename T> T get_or(Node * node, const std::string & name, T fallback) {{
  auto found = get<T>(node, name);
  return found.has_value() ? found.value() : fallback;
}}
template<> inline std::optional<bool> get(Node * node, const std::string & name) {{
  node->declare_parameter(name, rclcpp::PARAMETER_BOOL);
  return node->get_parameter(name).as_bool();
}}
template<> inline std::optional<std::string> get(Node * node, const std::string & name) {{
  node->declare_parameter(name, rclcpp::PARAMETER_STRING);
  return node->get_parameter(name).as_string();
}}
template<> inline std::optional<std::vector<std::string>> get(Node * node, const std::string & name) {{
  node->declare_parameter(name, rclcpp::PARAMETER_STRING_ARRAY);
  return node->get_parameter(name).as_string_array();
}}
}}
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{ std::string text = "q"; {body} }}
}};
"""
BY_NAME = """
#include <rclcpp/rclcpp.hpp>
template<typename T> void declare(rclcpp::Node * node, const std::string & name) {{ node->declare_parameter(name, T()); }}
template<> void declare<int>(rclcpp::Node * node, const std::string & name) {{ node->declare_parameter(name, 1); }}
template<> void declare<bool>(rclcpp::Node * node, const std::string & name) {{ node->declare_parameter(name, true); }}
class Demo : public rclcpp::Node {{ Demo() : Node("demo") {{ {body} }} }};
"""
OUT = """
#include <rclcpp/rclcpp.hpp>
class Demo : public rclcpp::Node {{
  Demo() : Node("demo") {{ {body} }}
  template <class T> bool load(std::string name, T & to);
  std::string text_;
  double number_ = 1.5;
}};
template <class T> bool Demo::load(std::string name, T & to) {{
  const std::string path = "group." + name;
  declare_parameter(path);
  return get_parameter(path, to);
}}
"""
ROWS = [
    (BY_SIGNATURE, 'util::get<bool>(this, "a");', [("a", "bool")]),
    (BY_SIGNATURE, 'util::get<std::vector<std::string>>(this, "a");', [("a", "string_array")]),
    (BY_SIGNATURE, 'util::get_or<std::string>(this, "a", "x");', [("a", "string")]),
    (BY_SIGNATURE, 'util::get_or(this, "a", std::vector<std::string>{});', [("a", "string_array")]),
    (BY_SIGNATURE, 'util::get_or(this, "a", text);', [("a", "string")]),
    (BY_SIGNATURE, 'util::get_or(this, "a", false);', [("a", "bool")]),
    (BY_NAME, 'declare<int>(this, "a"); declare<bool>(this, "b");', [("a", "integer"), ("b", "bool")]),
    (BY_NAME, 'declare<Other>(this, "a");', [("a", None)]),
    (OUT, 'load("a", text_); load("b", number_);', [("group.a", "string"), ("group.b", "double")]),
]


@pytest.mark.parametrize(("text", "body", "told"), ROWS, ids=[row[1] for row in ROWS])
def test_a_call_means_one_specialization(
    workspace: Any, text: str, body: str, told: list[tuple[str, str | None]]
) -> None:
    """By what the call names, or its arguments show; helpers that nobody calls have a hole for a name."""
    found = workspace.package({"src/demo.cpp": text.format(body=body)}).interfaces()
    named = [(entry.name, entry.type) for entry in found if "{" not in entry.name]
    assert sorted(named) == told


def test_of_a_type_that_nobody_knows_no_specialization_is_left_out(workspace: Any) -> None:
    """An argument whose type is not shown may mean each of them."""
    text = BY_SIGNATURE.format(body='util::get_or(this, "a", outside());')
    found = workspace.package({"src/demo.cpp": text}).interfaces()
    assert {entry.type for entry in found if entry.role == "parameter"} == {"bool", "string", "string_array"}
