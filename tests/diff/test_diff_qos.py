"""QoS that stands elsewhere than in the call: members of base classes, and the latch of ROS 1."""

from __future__ import annotations

import pytest
from diff_repos import node, package

CMAKE = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION lib/arm)\n"
BASE = """#include <rclcpp/rclcpp.hpp>
class Sensors : public rclcpp::Node {
public:
  Sensors() : Node("arm") {}
protected:
  rclcpp::QoS qos_ = rclcpp::QoS(rclcpp::KeepLast(10))%s;
};
"""
ARM = (
    node('p_ = create_publisher<std_msgs::msg::Bool>("done", %s);')
    .replace("rclcpp/rclcpp.hpp>", 'rclcpp/rclcpp.hpp>\n#include "sensors.hpp"')
    .replace("public rclcpp::Node", "public Sensors")
    .replace(' : Node("arm")', "")
)
ROS1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "roscpp")
CPP = """#include <ros/ros.h>
#include <std_msgs/Bool.h>
int main(int c, char ** v) {
  ros::init(c, v, "arm");
  ros::NodeHandle nh;
  auto p = nh.advertise<std_msgs::Bool>("done", 1%s);
}
"""
PYTHON = """#!/usr/bin/env python
import rospy
from std_msgs.msg import Bool
rospy.init_node('arm')
rospy.Publisher('done', Bool, queue_size=1%s)
"""


@pytest.mark.parametrize("member", ["qos_", "this->qos_"])
def test_qos_of_a_member_of_a_base_class(changes, member: str) -> None:  # type: ignore[no-untyped-def]
    """A profile that a base class declares is that of whoever publishes with it."""
    old = {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": ARM % member, "arm/src/sensors.hpp": BASE % ""}
    found = changes(old, {"arm/src/sensors.hpp": BASE % ".best_effort()"})
    assert [(each["kind"], each["new"], each["breaking"]) for each in found] == [
        ("qos", "/done reliability=best_effort", True)
    ]


@pytest.mark.parametrize(
    ("path", "text", "given"),
    [("src/arm.cpp", CPP, ", true"), ("scripts/arm.py", PYTHON, ", latch=True")],
)
def test_a_publisher_is_no_longer_latched(changes, path: str, text: str, given: str) -> None:  # type: ignore[no-untyped-def]
    """Who subscribes later waits; the other way nobody does."""
    make = CMAKE if path.endswith(".cpp") else "project(arm)\ninstall(PROGRAMS scripts/arm.py DESTINATION x)\n"
    old = {"arm/package.xml": ROS1, "arm/CMakeLists.txt": make, f"arm/{path}": text % given}
    found = changes(old, {f"arm/{path}": text % ""})
    assert [(each["kind"], each["old"], each["new"], each["breaking"]) for each in found] == [
        ("qos", "/done latch=true", "/done latch=false", True)
    ]


def test_a_latch_that_is_not_known_is_no_change(told) -> None:  # type: ignore[no-untyped-def]
    """A flag that the tree does not show is neither."""
    old = {"arm/package.xml": ROS1, "arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": CPP % ", true"}
    assert told(old, {"arm/src/arm.cpp": CPP % ", latched(c)"}) == set()
