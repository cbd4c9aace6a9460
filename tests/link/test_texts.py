"""The name of an endpoint is found by what its argument is, whatever it is called."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <ros/ros.h>
const std::string kServer = "grip";
class Arm {{
 public:
  Arm() : pnh_("~") {{
    std::string gripper = "grip";
    {body}
  }}
 private:
  ros::NodeHandle pnh_;
  std::string held_ = "grip";
}};
int main(int argc, char ** argv) {{
  ros::init(argc, argv, "arm");
  Arm arm;
}}
"""
BODIES = [
    ("new actionlib::SimpleActionClient<demo_msgs::GripAction>(gripper, false);", "/grip"),
    ("new actionlib::SimpleActionClient<demo_msgs::GripAction>(pnh_, gripper, false);", "/arm/grip"),
    ("new actionlib::SimpleActionClient<demo_msgs::GripAction>(held_, false);", "/grip"),
    ("new actionlib::SimpleActionClient<demo_msgs::GripAction>(this->pnh_, this->held_, false);", "/arm/grip"),
    ("new actionlib::SimpleActionClient<demo_msgs::GripAction>(kServer);", "/grip"),
]


@pytest.mark.parametrize(("body", "name"), BODIES)
def test_the_name_is_the_argument_that_is_text(workspace: Any, body: str, name: str) -> None:
    """A variable that holds a text is the name, and one that holds a node handle is not."""
    assert workspace.package({"src/arm.cpp": CPP.format(body=body)}, 1).only("action_client").name == name


def test_the_queue_of_a_filter_is_that_of_its_subscriber(workspace: Any) -> None:
    """`message_filters.Subscriber` of rospy gives its keywords to the subscriber that it makes."""
    source = """#!/usr/bin/env python
import rospy
import message_filters
from sensor_msgs.msg import Image

if __name__ == '__main__':
    rospy.init_node('demo')
    image = message_filters.Subscriber('image', Image, queue_size=3)
"""
    entry = workspace.package({"scripts/demo.py": source}, 1).only("subscriber")
    assert entry.qos is not None
    assert entry.qos.depth == 3


ADDED = """#!/usr/bin/env python
import sys
import rospy
name = {begin}

def read():
    global name
    rospy.get_param("~cost_" + name + "/x", 5)

def give(value):
    global name
    name = {given}

rospy.init_node("demo")
give(sys.argv[1])
read()
"""
SUMS = [
    ("None", "value", ["/demo/cost_{item}/x"]),
    ("None", "'left'", ["/demo/cost_left/x"]),
    ("'left'", "value", ["/demo/cost_left/x", "/demo/cost_{item}/x"]),
    ("None", "unicode(value)", ["/demo/cost_{unicode}/x"]),
]


@pytest.mark.parametrize(("begin", "given", "names"), SUMS, ids=[f"{row[0]} {row[1]}" for row in SUMS])
def test_a_text_stays_beside_what_may_be_none(workspace: Any, begin: str, given: str, names: list[str]) -> None:
    """Whoever adds `None` to a text raises: what is left is the text with what else the variable may hold."""
    found = workspace.package({"scripts/demo.py": ADDED.format(begin=begin, given=given)}, ros=1).interfaces()
    assert sorted(entry.name for entry in found if entry.role == "parameter") == names
