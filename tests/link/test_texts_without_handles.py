"""A name that stands where an overload has a handle is a name, however the variable that holds it is declared."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """#include <ros/ros.h>
#include <actionlib/client/simple_action_client.h>
#include <control_msgs/GripperCommandAction.h>

using Client = actionlib::SimpleActionClient<control_msgs::GripperCommandAction>;

template <class T>
bool ask(const ros::NodeHandle& nh, const std::string& key, T* value)
{
  return nh.getParam(key, *value);
}

int main(int argc, char** argv)
{
  ros::init(argc, argv, "hand");
  ros::NodeHandle own("~");
  BODY
  Client client(name);
  ros::spin();
}
"""
ROWS = [
    ("made by auto, read through a pointer", 'auto name = std::string(); if (!ask(own, "grip", &name)) { return 1; }'),
    ("made by auto, read", 'auto name = std::string(); if (!own.getParam("grip", name)) { return 1; }'),
    ("declared, read", 'std::string name; if (!own.getParam("grip", name)) { return 1; }'),
    ("declared with a text, read", 'std::string name = ""; if (!own.getParam("grip", name)) { return 1; }'),
]


@pytest.mark.parametrize("body", [row[1] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_client_has_the_name_that_a_parameter_gives(workspace: Any, body: str) -> None:
    """Such clients were missed without a word, or told below a handle that their own name was taken for."""
    files = {
        "src/hand.cpp": NODE.replace("BODY", body),
        "CMakeLists.txt": "project(pkg)\nadd_executable(hand src/hand.cpp)\n",
    }
    found = workspace.package(files, ros=1).interfaces()
    named = {(entry.role, entry.name) for entry in found if entry.role == "action_client"}
    assert len(named) == 1
    ((_, name),) = named
    assert name.count("{") == 1
    assert {entry.type for entry in found if entry.name.endswith("grip")} == {"string"}
