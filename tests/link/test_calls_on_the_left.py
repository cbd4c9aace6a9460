"""Calls within what a statement changes run as those do whose value it takes."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <ros/ros.h>
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle pnh("~");
  {body}
}}
"""
PYTHON = """#!/usr/bin/env python
import rospy
if __name__ == "__main__":
    rospy.init_node("demo")
    {body}
"""
READ = 'pnh.param<int>("at", 2)'
ASKED = 'rospy.get_param("~at", 2)'
ROWS = [
    ("an element of C++", "cpp", f"axes[{READ}] = 1.0;"),
    ("an element of a field", "cpp", f"joy->axes[{READ}] = 1.0;"),
    ("an element that a method gives", "cpp", f"axes.at({READ}) = 1.0;"),
    ("an element of Python", "py", f"axes[{ASKED}] = 1.0"),
    ("a field of what a call gives", "py", f"part({ASKED}).speed = 1.0"),
    ("one of several", "py", f"first, axes[{ASKED}] = 1.0, 2.0"),
]


@pytest.mark.parametrize(("language", "body"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_call_within_what_is_assigned_to(workspace: Any, language: str, body: str) -> None:
    """A parameter that says which element is changed is one: nothing was told of it."""
    text = CPP if language == "cpp" else PYTHON
    build = "add_executable(demo src/demo.cpp)" if language == "cpp" else "catkin_install_python(PROGRAMS src/demo.py)"
    files = {f"src/demo.{language}": text.format(body=body), "CMakeLists.txt": f"project(pkg)\n{build}\n"}
    found = workspace.package(files, ros=1).only("parameter")
    assert (found.name, found.default) == ("/demo/at", 2)
