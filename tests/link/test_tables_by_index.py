"""Tables of structures that are members, read by an index, in a constructor as in any other method."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
std::string given();
struct Row {{ std::string name; double rate; }};
class N : public rclcpp::Node {{
public:
  N(int n) : Node("n") {{ {constructor} }}
  void setup() {{ {method} }}
  {member}
}};
int main(int argc, char ** argv) {{
  rclcpp::init(argc, argv);
  auto node = std::make_shared<N>(argc);
  {main}
  rclcpp::spin(node);
}}
"""
ROWS = 'std::vector<Row> rows_{{"a", 1.0}, {"b", 2.0}};'
ARRAY = 'static constexpr std::array<Row, 2> rows_{{{"a", 1.0}, {"b", 2.0}}};'
LOOP = "for (size_t i = 0; i < rows_.size(); ++i) { create_publisher<std_msgs::msg::String>(rows_[i].name, 10); }"
AT = "create_publisher<std_msgs::msg::String>(rows_.at(1).name, 10);"
TEXTS = 'std::vector<std::string> rows_{"a", "b"};'
PLAIN = 'for (size_t i = 0; i < rows_.size(); ++i) { create_publisher<std_msgs::msg::String>("" + rows_[i], 10); }'


def names(workspace: Any, **parts: str) -> set[tuple[str, str]]:
    source = NODE.format(**{"constructor": "", "method": "", "member": "", "main": "", **parts})
    found = workspace.package({"src/n.cpp": source}).interfaces()
    return {(one.name, one.confidence) for one in found if one.role == "publisher"}


@pytest.mark.parametrize("where", ["constructor", "method"])
@pytest.mark.parametrize(("member", "loop"), [(ROWS, LOOP), (ARRAY, LOOP), (TEXTS, PLAIN)])
def test_an_index_takes_a_row_out_of_a_table(workspace: Any, where: str, member: str, loop: str) -> None:
    """A counted loop over a member makes an endpoint for each row, also while the constructor is run."""
    assert names(workspace, **{where: loop, "member": member}) == {("/a", "folded"), ("/b", "folded")}


def test_a_row_is_taken_by_its_method_as_well(workspace: Any) -> None:
    """`rows.at(1)` is `rows[1]`."""
    assert names(workspace, constructor=AT, member=ROWS) == {("/b", "folded")}


@pytest.mark.parametrize("change", ["rows_[0].name = given();", "auto & row = rows_[0]; row.name = given();"])
def test_a_row_whose_field_was_given_something_is_not_what_it_was(workspace: Any, change: str) -> None:
    """What the table begins with is stale behind a change of a field."""
    told = names(
        workspace, constructor=f"{change} create_publisher<std_msgs::msg::String>(rows_[0].name, 10);", member=ROWS
    )
    assert ("/a", "folded") not in told
    assert told


@pytest.mark.parametrize(
    "change",
    ['node->rows_.push_back("c");', "node->rows_[0] = given();", 'node->rows_ = {"c"};', "node->rows_.clear();"],
)
def test_a_member_that_others_change_is_not_what_it_is_declared_with(workspace: Any, change: str) -> None:
    """A function that has the object fills its public list before the method runs: it was told as proved."""
    assert {how for _, how in names(workspace, method=PLAIN, member=TEXTS, main=change)} == {"pattern"}


def test_a_field_of_a_row_that_others_change_is_open(workspace: Any) -> None:
    """So does one who writes into a row."""
    told = names(workspace, method=LOOP, member=ROWS, main="node->rows_[0].name = given();")
    assert {how for _, how in told} == {"pattern"}


def test_an_element_behind_a_pointer_is_open(workspace: Any) -> None:
    """Who has the address of an element may write it: `p->name = x`."""
    made = "create_publisher<std_msgs::msg::String>(rows[0].name, 10);"
    body = 'std::vector<Row> rows{{"a", 1.0}}; Row * p = &rows[0]; p->name = given(); ' + made
    assert ("/a", "folded") not in names(workspace, constructor=body)
