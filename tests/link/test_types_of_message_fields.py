"""Parameters that are read into fields of messages, whose package is not in the tree."""

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
