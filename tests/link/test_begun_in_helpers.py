"""A helper that begins its variable with what it was given falls back to that."""

from __future__ import annotations

from typing import Any

import pytest

HELPER = """
#include <ros/ros.h>
template <typename T>
T read(const ros::NodeHandle & nh, const std::string & name, const T & otherwise) {{
  T value = otherwise;
  {body}
}}
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh("~");
  std::string topic = read(nh, "topic", std::string("map"));
  auto pub = nh.advertise<std_msgs::String>(topic, 1);
}}
"""
ROWS = [
    ('if (!nh.getParam(name, value)) { ROS_WARN("unset"); } else { ROS_INFO("set"); } return value;', "map"),
    ("nh.getParam(name, value); return value;", "map"),
    ("if (!nh.getParam(name, value)) { exit(1); } return value;", None),
    ("if (!nh.getParam(name, value)) { throw Unset(name); } return value;", None),
    ("if (ready()) value = T(); nh.getParam(name, value); return value;", None),
]


@pytest.mark.parametrize(("body", "default"), ROWS, ids=[row[0] for row in ROWS])
def test_what_a_helper_begins_with_is_the_default(workspace: Any, body: str, default: object) -> None:
    """It is given back where nothing was read, unless something is done with it, or the run may end instead."""
    workspace.package({"src/demo.cpp": HELPER.format(body=body)}, ros=1)
    assert workspace.only("parameter").default == default
    assert (workspace.only("publisher").name == "/demo/map") is (default is not None)


def test_what_somebody_may_have_changed_is_no_default(workspace: Any) -> None:
    """A function that nobody sees may write to the variable that it is handed."""
    body = "change(value); nh.getParam(name, value); return value;"
    workspace.package({"src/demo.cpp": HELPER.format(body=body)}, ros=1)
    assert workspace.only("parameter").default is None
