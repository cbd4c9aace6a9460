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


FIELDS = """
#include <rclcpp/rclcpp.hpp>
class P : public base::Plugin {{
public:
  bool initialize(const std::string & name, const rclcpp::Node::SharedPtr & node) override {{
    name_ = name;
    config_.reach = node->declare_parameter(name_ + ".reach", config_.reach);
    return true;
  }}
  void changed(std::vector<rclcpp::Parameter> parameters) {{
    for (auto parameter : parameters) {{
      if (parameter.get_name() == name_ + ".reach") {{ config_.reach = parameter.as_double(); }}
    }}
  }}
  {more}
private:
  std::string name_;
  struct {{ double reach = 0.3; }} config_;
}};
PLUGINLIB_EXPORT_CLASS(P, base::Plugin)
"""
GIVEN = [
    ("by nobody else", "", 0.3),
    ("by another method", "void set(double reach) { config_.reach = reach; }", None),
    ("something unknown", "void set() { config_.reach = measured(); }", None),
]


@pytest.mark.parametrize(("more", "default"), [row[1:] for row in GIVEN], ids=[row[0] for row in GIVEN])
def test_a_field_that_is_its_own_default_holds_what_it_begins_with(
    workspace: Any, more: str, default: float | None
) -> None:
    """What a callback takes out of a parameter is what somebody set, who sets the default no more."""
    found = workspace.package({"src/p.cpp": FIELDS.format(more=more)}).only("parameter")
    assert (found.type, found.default) == ("double", default)


LATER = """
#include <rclcpp/rclcpp.hpp>
struct Config {{ std::string topic = "begun"; }};
class D : public rclcpp::Node {{
public:
  D() : Node("demo") {{}}
  void init() {{ config_.topic = {first}; }}
  void changed(std::vector<rclcpp::Parameter> parameters) {{
    for (auto parameter : parameters) {{ config_.topic = parameter.as_string(); }}
  }}
  void start() {{ pub_ = create_publisher<std_msgs::msg::String>(config_.topic, 1); }}
  Config config_;
}};
int main(int argc, char ** argv) {{ rclcpp::spin(std::make_shared<D>()); }}
"""
FIRST = [
    ("a parameter", 'declare_parameter("topic", std::string("asked"))', ("/asked", "default")),
    ("a text", '"fixed"', ("/fixed", "one_of")),
]


@pytest.mark.parametrize(("first", "expected"), [row[1:] for row in FIRST], ids=[row[0] for row in FIRST])
def test_what_a_callback_sets_later_is_a_setting_of_a_parameter_and_replaces_a_text(
    workspace: Any, first: str, expected: tuple[str, str]
) -> None:
    """A text that a callback may replace is not proved."""
    found = workspace.package({"src/d.cpp": LATER.format(first=first)}).interfaces()
    assert expected in {(each.name, each.confidence) for each in found if each.role == "publisher"}


TWO_READS = """
#include <ros/ros.h>
class Second {
public:
  Second() : pnh_("~") {
    std::string topic;
    pnh_.param("topic", topic, std::string("/second/objects"));
    sub_ = nh_.subscribe<std_msgs::String>(topic, 1, &Second::heard, this);
  }
  void heard(const std_msgs::String::ConstPtr & message) {}
  ros::NodeHandle nh_, pnh_; ros::Subscriber sub_;
};
class First {
public:
  First() : pnh_("~") {
    std::string topic("/first/objects");
    pnh_.getParam("topic", topic);
    sub_ = nh_.subscribe(topic, 1, &First::heard, this);
  }
  void heard(const std_msgs::String::ConstPtr & message) {}
  ros::NodeHandle nh_, pnh_; ros::Subscriber sub_;
  Second second_;
};
int main(int argc, char ** argv) {
  ros::init(argc, argv, "demo");
  First first;
  ros::spin();
}
"""


def test_the_default_of_one_read_is_not_that_of_another(workspace: Any) -> None:
    """In ROS 1 each read of a parameter falls back to what it says itself: what another says is on no server."""
    found = workspace.package({"src/demo.cpp": TWO_READS}, ros=1).interfaces()
    assert {entry.name for entry in found if entry.role == "subscriber"} == {"/first/objects", "/second/objects"}
