"""Parameters that are read into fields of messages, whose package is in the tree or not."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
#include <ros/ros.h>
#include <geometry_msgs/PoseStamped.h>
using Posed = geometry_msgs::PoseStamped;
struct Demo {{
  {member}
  Demo() {{ ros::NodeHandle pnh("~"); pnh.getParam("value", {field}); }}
}};
int main(int argc, char ** argv) {{ ros::init(argc, argv, "demo"); Demo demo; }}
"""
FIELDS = [
    ("geometry_msgs::PoseStamped goal;", "goal.pose.position.x", "double"),
    ("geometry_msgs::PoseStamped goal;", "goal.header.frame_id", "string"),
    ("geometry_msgs::PoseStamped goal;", "this->goal.pose.orientation.w", "double"),
    ("Posed goal;", "goal.pose.position.x", "double"),
    ("geometry_msgs::PoseStamped goal;", "goal.pose.other", None),
    ("other_msgs::PoseStamped goal;", "goal.pose.position.x", None),
]


@pytest.mark.parametrize(("member", "field", "kind"), FIELDS)
def test_a_field_of_a_known_message_has_a_type(workspace: Any, member: str, field: str, kind: str | None) -> None:
    """A parameter that is read into a field has the type that its message gives it; of others nothing is said."""
    found = workspace.package({"src/d.cpp": TEXT.format(member=member, field=field)}, ros=1).only("parameter")
    assert (found.name, found.type) == ("/demo/value", kind)


OWN = """
#include <rclcpp/rclcpp.hpp>
#include "pkg/srv/start.hpp"
#include "pkg/msg/plan.hpp"
class N : public rclcpp::Node {{
public:
  N() : Node("n", rclcpp::NodeOptions().allow_undeclared_parameters(true)) {{
    auto request = std::make_shared<pkg::srv::Start::Request>();
    pkg::msg::Plan plan;
    get_parameter("value", {field});
  }}
}};
int main(int c, char ** v) {{ rclcpp::init(c, v); rclcpp::spin(std::make_shared<N>()); }}
"""
OWN_FIELDS = [
    ("request->channel", "string"),
    ("request->scale", "double"),
    ("request->plan.ids", "integer_array"),
    ("plan.steps", "integer"),
    ("plan.header.frame_id", "string"),
    ("request->done", None),
]


@pytest.mark.parametrize(("field", "kind"), OWN_FIELDS)
def test_a_field_of_a_message_of_the_tree_has_a_type(workspace: Any, field: str, kind: str | None) -> None:
    """What a package of the tree defines is read: a field of a request, of a message, and of a message within it."""
    files = {
        "src/d.cpp": OWN.format(field=field),
        "srv/Start.srv": "string channel\nfloat32 scale\nPlan plan\n---\nbool done\n",
        "msg/Plan.msg": "std_msgs/Header header\nint32 steps\nint64[] ids\n",
    }
    found = workspace.package(files).only("parameter")
    assert (found.name, found.type) == ("value", kind)
