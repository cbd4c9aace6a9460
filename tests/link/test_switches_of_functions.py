"""Branches on variables of the function itself that one statement gives a literal, and nobody anything else."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
import rospy
from std_msgs.msg import Bool
{module}
def work():
{work}
if __name__ == "__main__":
    rospy.init_node("demo")
    flag = False
{body}
    if {test}:
        rospy.Publisher("perhaps", Bool, queue_size=1)
    work()
"""
CPP = """
#include <ros/ros.h>
#include <std_msgs/Bool.h>
void look(bool flag);
void change(bool & flag);
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "demo");
  ros::NodeHandle nh;
  {declared}
  {body}
  if ({test}) nh.advertise<std_msgs::Bool>("perhaps", 1);
}}
"""
PLAIN = {"module": "", "work": "    pass", "body": "    pass", "test": "flag"}
NEVER = [{}, {"test": "flag and other()"}, {"body": "    print(flag)"}, {"body": "    if flag:\n        print(1)"}]
MAYBE = [
    {"test": "not flag"},
    {"body": "    if argv:\n        flag = True"},
    {"work": "    global flag\n    flag = True"},
    {"body": "    for flag in found():\n        pass"},
    {"body": "    flag += 1"},
]
NEVER_CPP = [
    ("bool flag = false;", "", "flag"),
    ("int flag = 0;", "ROS_INFO_STREAM(flag);", "flag > 0"),
]
MAYBE_CPP = [
    ("bool flag = false;", "", "!flag"),
    ("bool flag = false;", "change(flag);", "flag"),
    ("bool flag = false;", "bool & other = flag; other = true;", "flag"),
    ("bool flag = false;", 'nh.getParam("flag", flag);', "flag"),
    ("bool flag = false;", "auto set = [&]() { flag = true; }; set();", "flag"),
    ("bool flag;", "if (argc > 1) flag = false;", "flag"),
    ("bool flag = argc > 1;", "", "flag"),
]


def _publishers(workspace: Any, files: dict[str, str]) -> list[str]:
    return [entry.name for entry in workspace.package(files, ros=1).interfaces() if entry.role == "publisher"]


@pytest.mark.parametrize(("given", "told"), [(each, []) for each in NEVER] + [(each, ["/perhaps"]) for each in MAYBE])
def test_a_switch_of_a_script(workspace: Any, given: dict[str, str], told: list[str]) -> None:
    """What stands behind a switch that the script itself states once, as off, is made by no run of it."""
    assert _publishers(workspace, {"scripts/d.py": PYTHON.format(**{**PLAIN, **given})}) == told


@pytest.mark.parametrize(
    ("text", "told"), [(each, []) for each in NEVER_CPP] + [(each, ["/perhaps"]) for each in MAYBE_CPP]
)
def test_a_switch_of_a_program(workspace: Any, text: tuple[str, str, str], told: list[str]) -> None:
    """The same of C++, unless a reference, a read of a parameter or a lambda may give it something else."""
    declared, body, test = text
    assert _publishers(workspace, {"src/d.cpp": CPP.format(declared=declared, body=body, test=test)}) == told
