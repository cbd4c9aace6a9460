"""Containers that are made in braces or in parentheses, as members, variables and defaults."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
std::string given();
class N : public rclcpp::Node {{
public:
  N(int n) : Node("n"){first} {{ {body} }}
  {member}
}};
int main(int argc, char ** argv) {{ rclcpp::init(argc, argv); rclcpp::spin(std::make_shared<N>(argc)); }}
"""
DECLARED = 'declare_parameter("x", x_);'
TEXTS, NUMBERS = "std::vector<std::string> x_;", "std::vector<double> x_;"
DEFAULTS = [
    ("one text", ', x_{"a"}', DECLARED, TEXTS, "string_array", ["a"]),
    ("two texts", ', x_{"a", "b"}', DECLARED, TEXTS, "string_array", ["a", "b"]),
    ("a list in parentheses", ', x_({"a"})', DECLARED, TEXTS, "string_array", ["a"]),
    ("one number", ", x_{5}", DECLARED, NUMBERS, "double_array", [5.0]),
    ("a count", ", x_(2)", DECLARED, NUMBERS, "double_array", [0.0, 0.0]),
    ("a count of values", ", x_(2, 1.5)", DECLARED, NUMBERS, "double_array", [1.5, 1.5]),
    ("a count that is open", ", x_(n)", DECLARED, NUMBERS, "double_array", None),
    ("an alias", ', x_{"a"}', DECLARED, "using Texts = std::vector<std::string>; Texts x_;", "string_array", ["a"]),
    ("no container", ', x_{"a"}', DECLARED, "std::string x_;", "string", "a"),
    ("made in braces", "", 'declare_parameter("x", std::vector<double>{1, 2});', "", "double_array", [1.0, 2.0]),
    ("made of a count", "", 'declare_parameter("x", std::vector<int64_t>(2));', "", "integer_array", [0, 0]),
    ("a variable of a count", "", 'std::vector<bool> x(1); declare_parameter("x", x);', "", "bool_array", [False]),
    ("a count of a truth", "", 'declare_parameter("x", std::vector<bool>(2, 0));', "", "bool_array", [False, False]),
    ("a default of a count", "", DECLARED, "std::vector<double> x_ = std::vector<double>(1);", "double_array", [0.0]),
    ("a copy of iterators", "", 'declare_parameter("x", std::vector<double>(y_.begin(), y_.end()));',
     "std::vector<double> y_{1.0};", "double_array", [1.0]),
    ("a number of another type", "", 'double x = 3; declare_parameter("x", x);', "", "double", 3.0),
]  # fmt: skip


@pytest.mark.parametrize(
    ("first", "body", "member", "kind", "default"), [row[1:] for row in DEFAULTS], ids=[row[0] for row in DEFAULTS]
)
def test_braces_hold_the_elements_of_a_container_and_parentheses_their_count(
    workspace: Any, first: str, body: str, member: str, kind: str, default: Any
) -> None:
    """One element in braces is a list of one, a count makes that many of nothing, and its type says what they are."""
    found = workspace.package({"src/n.cpp": NODE.format(first=first, body=body, member=member)}).only("parameter")
    assert (found.type, found.default) == (kind, default)


def test_names_are_taken_from_the_elements_and_not_from_the_letters_of_one(workspace: Any) -> None:
    """A loop over a list of one text has one round: it had one for each letter."""
    body = 'for (size_t i = 0; i < x_.size(); ++i) { declare_parameter(x_[i] + ".plugin", y_[i]); }'
    source = NODE.format(first=', x_{"one"}, y_{"pkg/One"}', body=body, member="std::vector<std::string> x_, y_;")
    found = workspace.package({"src/n.cpp": source}).only("parameter")
    assert (found.name, found.default) == ("one.plugin", "pkg/One")


@pytest.mark.parametrize(
    "change",
    [
        "x[0] = given();",
        "x.at(0) = given();",
        "for (auto & one : x) { one = given(); }",
        "std::generate(x.begin(), x.end(), given);",
    ],
)
def test_elements_that_are_given_later_are_not_what_the_count_made_them(workspace: Any, change: str) -> None:
    """An empty text of a counted list is stale as soon as anything may be written there."""
    body = f'std::vector<std::string> x(1); {change} create_publisher<std_msgs::msg::String>("a/" + x[0], 10);'
    found = workspace.package({"src/n.cpp": NODE.format(first="", body=body, member="")}).only("publisher")
    assert found.confidence == "pattern"


@pytest.mark.parametrize("made", ["std::vector<std::string>(y_.begin(), y_.end())", "copy()"])
def test_a_range_is_the_elements_between_its_ends(workspace: Any, made: str) -> None:
    """`{x.begin(), x.end()}` is a copy of `x`, and no list of two."""
    body = f'for (const auto & each : {made}) {{ create_publisher<std_msgs::msg::String>("of/" + each, 10); }}'
    copy = "std::vector<std::string> copy() { return {y_.cbegin(), y_.cend()}; }"
    member = f'{copy} std::vector<std::string> y_{{"a", "b"}};'
    found = workspace.package({"src/n.cpp": NODE.format(first="", body=body, member=member)}).interfaces()
    assert {one.name for one in found if one.role == "publisher"} == {"/of/a", "/of/b"}
