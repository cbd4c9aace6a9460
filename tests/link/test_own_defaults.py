"""Members that are the default of the parameter which they are then given, in a method that a host calls."""

from __future__ import annotations

from typing import Any

import pytest

PLUGIN = """
#include <rclcpp/rclcpp.hpp>
class P : public base::Plugin {{
public:
  bool initialize(const std::string & name, const rclcpp::Node::SharedPtr & node) override {{
    name_ = name;
    node_ = node;
    reach_ = node_->declare_parameter(name_ + ".reach", reach_);
    return true;
  }}
  {more}
private:
  rclcpp::Node::SharedPtr node_;
  std::string name_;
  {member}
}};
PLUGINLIB_EXPORT_CLASS(P, base::Plugin)
"""
ROWS = [
    ("begun", "double reach_ = 0.3;", "", 0.3),
    ("not begun", "double reach_;", "", None),
    ("given by another method", "double reach_ = 0.3;", "void set(double reach) { reach_ = reach; }", None),
    ("given something unknown", "double reach_ = 0.3;", "void set() { reach_ = measured(); }", None),
]


@pytest.mark.parametrize(("member", "more", "default"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_member_that_only_its_own_parameter_is_read_into_holds_what_it_begins_with(
    workspace: Any, member: str, more: str, default: float | None
) -> None:
    """What a declaration gives the member that is its default adds nothing to it; what else is given may come before."""
    found = workspace.package({"src/p.cpp": PLUGIN.format(member=member, more=more)}).only("parameter")
    assert (found.type, found.default) == ("double", default)
