"""Names of actions that a text gives by a method: they stand where another overload takes a node handle."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
#include <ros/ros.h>
#include <actionlib/client/simple_action_client.h>
#include <demo_msgs/GoAction.h>
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "n");
  ros::NodeHandle nh, own("~");
  std::string name = "go", asked;
  own.getParam("asked", asked);
  actionlib::SimpleActionClient<demo_msgs::GoAction> client({arguments});
  ros::spin();
}}
"""
ROWS = [
    ("a text", "name, true", "/go"),
    ("its characters", "name.c_str(), true", "/go"),
    ("characters of what is asked", "asked.c_str(), true", "/{asked}"),
    ("below a handle", "own, name, true", "/n/go"),
    ("characters below a handle", "own, name.c_str(), true", "/n/go"),
]


@pytest.mark.parametrize(("arguments", "name"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_what_is_the_name_is_no_handle(workspace: Any, arguments: str, name: str) -> None:
    """One argument is not both."""
    found = workspace.package({"src/n.cpp": SOURCE.format(arguments=arguments)}, ros=1).only("action_client")
    assert found.name == name
