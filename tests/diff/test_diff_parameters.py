"""Parameters of ROS 1 over two releases: one name in two writings, and names that are computed now."""

from __future__ import annotations

import pytest
from diff_repos import node, package

CFG = """#!/usr/bin/env python
from dynamic_reconfigure.parameter_generator_catkin import *
gen = ParameterGenerator()
gen.add("gain", double_t, 0, "Gain.", 0.5, 0.0, 1.0)
exit(gen.generate("arm", "arm", "Arm"))
"""
PROGRAM = """#include <ros/ros.h>
#include <dynamic_reconfigure/server.h>
#include <arm/ArmConfig.h>
int main(int c, char ** v) {
  ros::init(c, v, "arm");
  ros::NodeHandle nh("~");
  dynamic_reconfigure::Server<arm::ArmConfig> server;
  %s
}
"""
SCRIPT = """#!/usr/bin/env python
import sys
import rospy
rospy.init_node('arm')
%s
"""
READ = 'double gain; nh.getParam("gain", gain);'
ROS1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "roscpp")
CMAKE = "project(arm)\nadd_executable(arm src/arm.cpp)\n"
INSTALLED = "project(arm)\ncatkin_install_python(PROGRAMS arm.py DESTINATION bin)\n"


@pytest.mark.parametrize(("before", "after"), [("", READ), (READ, "")])
def test_a_parameter_of_a_cfg_that_the_program_reads_as_well(told, before: str, after: str) -> None:  # type: ignore[no-untyped-def]
    """Its server and a private handle put it into one place."""
    files = {"arm/package.xml": ROS1, "arm/CMakeLists.txt": CMAKE, "arm/cfg/Arm.cfg": CFG}
    old = {**files, "arm/src/arm.cpp": PROGRAM % before}
    assert told(old, {"arm/src/arm.cpp": PROGRAM % after}) == set()


@pytest.mark.parametrize(
    ("name", "is_told"), [("place + 'rate'", False), ("'/slow' + place + 'rate'", True), ("'slow_rate'", True)]
)
def test_a_name_behind_a_place_that_is_computed(changes, name: str, is_told: bool) -> None:  # type: ignore[no-untyped-def]
    """The place may be the one that it had, and end in a slash."""
    old = {
        "arm/package.xml": ROS1,
        "arm/CMakeLists.txt": INSTALLED,
        "arm/arm.py": SCRIPT % "rospy.get_param('rate', 1)",
    }
    read = f"place = sys.argv[1]\nrospy.get_param({name}, 1)"
    found = changes(old, {"arm/arm.py": SCRIPT % read})
    assert any(each["breaking"] for each in found) is is_told


COMPUTED = "declare_parameter(read_name(), 1);"


@pytest.mark.parametrize(
    ("before", "after", "breaking"),
    [
        (('declare_parameter("rate", 1);',), (COMPUTED,), [False]),
        (('declare_parameter("rate", 1);', COMPUTED), (COMPUTED,), [True]),
        (('declare_parameter("rate", 1);',), ('declare_parameter("slow_" + read_name(), 1);',), [True]),
        (('declare_parameter("limits.rate", 1);',), ('declare_parameter("limits." + read_name(), 1);',), [False]),
    ],
)
def test_a_name_that_is_computed_now(
    changes, before: tuple[str, ...], after: tuple[str, ...], breaking: list[bool]
) -> None:  # type: ignore[no-untyped-def]
    """What is declared by a name that is not known may be what is gone, and so may one that fits a pattern."""
    files = {"arm/package.xml": package("arm"), "arm/CMakeLists.txt": CMAKE}
    found = changes({**files, "arm/src/arm.cpp": node(*before)}, {"arm/src/arm.cpp": node(*after)})
    assert [each["breaking"] for each in found if each["change"] == "removed"] == breaking
