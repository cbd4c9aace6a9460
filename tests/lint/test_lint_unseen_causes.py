"""Near-misses that repositories showed that nobody had looked at."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

SPREAD = """def pose(more):
    return {0}


a, b, c, d = pose([2, 3, 4])
"""
NODE = """#include <rclcpp/rclcpp.hpp>
namespace pkg {{
class Arm : public rclcpp::Node {{
public:
  explicit Arm(const rclcpp::NodeOptions & o) : Node("arm", o) {{ declare_parameter("{0}", 1); }}
}};
}}
RCLCPP_COMPONENTS_REGISTER_NODE(pkg::Arm)
"""
CONTAINER = """from launch import LaunchDescription
from launch.substitutions import PathJoinSubstitution
from launch_ros.actions import ComposableNodeContainer
from launch_ros.descriptions import ComposableNode
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    path = PathJoinSubstitution([FindPackageShare("pkg"), "config", "arm.yaml"])
    arm = ComposableNode(package="pkg", plugin="pkg::Arm", name="arm", parameters=[path])
    return LaunchDescription([
        ComposableNodeContainer(
            name="all", namespace="", package="rclcpp_components", executable="component_container",
            composable_node_descriptions=[arm],
        )
    ])
"""
COMPONENT = """project(pkg)
add_library(arm SHARED arm.cpp)
rclcpp_components_register_nodes(arm "pkg::Arm")
install(TARGETS arm DESTINATION lib)
ament_package()
"""
SENT = "void A::send() {{ sensor_msgs::Image image; {0} pub_.publish(image); }}\n"
SERIALIZED = "class State:\n    def write(self):\n        raise ValueError(_x)\n"
PLUGIN = '<library path="arm"><class type="pkg::A" base_class_type="{0}"/></library>'
EXPORTS = "PLUGINLIB_EXPORT_CLASS(pkg::A, core::Base)\nPLUGINLIB_EXPORT_CLASS(pkg::A, flow::Base)\n"


def told(workspace: Workspace, rule: str) -> int:
    return sum(finding.rule == rule for finding in lint(workspace.root))


def test_a_star_gives_any_number_of_values(workspace: Workspace) -> None:
    """LNT051: two values are two, one and a star are as many as there are."""
    workspace.package({"scripts/a.py": SPREAD.format("1, 2"), "scripts/b.py": SPREAD.format("1, *more")})
    assert told(workspace, "LNT051") == 1


@pytest.mark.parametrize(("target", "findings"), [("a, b", 1), ("a, *b", 0), ("(a, *b)", 0), ("a[2 * i], b", 1)])
def test_a_variable_may_take_what_is_left_over(workspace: Workspace, target: str, findings: int) -> None:
    """LNT051: told by the star of the variable, not by a star in the line."""
    text = f"#!/usr/bin/env python3\ndef f():\n    return 1, 2, 3\n\n\n{target} = f()\n"
    workspace.package({"scripts/a.py": text}, ros=1)
    assert told(workspace, "LNT051") == findings


def test_nested_keys_are_joined_with_dots(workspace: Workspace) -> None:
    """LNT005: a file without a node, as components get it, gives `port.rate` and no `port/rate`."""
    files = {"launch/a.launch.py": CONTAINER, "CMakeLists.txt": COMPONENT, "config/arm.yaml": "port:\n  rate: 1\n"}
    workspace.package({**files, "arm.cpp": NODE.format("port.rate")}, name="pkg")
    assert told(workspace, "LNT005") == 0
    workspace.package({"arm.cpp": NODE.format("port.rates")}, name="pkg")
    assert told(workspace, "LNT005") == 1


def test_who_has_the_address_may_write_the_header(workspace: Workspace) -> None:
    """LNT024: a pointer that is kept elsewhere leads to the message."""
    build = "project(pkg)\nadd_library(a a.cpp)\ncatkin_package()\n"
    workspace.package({"a.cpp": SENT.format(""), "CMakeLists.txt": build}, ros=1)
    assert told(workspace, "LNT024") == 1
    workspace.package({"a.cpp": SENT.format("info.output = &image; fill(info);")}, ros=1)
    assert told(workspace, "LNT024") == 0


def test_what_genpy_has_written_nobody_mends(workspace: Workspace) -> None:
    """LNT011: the serialization of an interface of the package; a private module of people is theirs to mend."""
    files = {"msg/State.msg": "float64 a\n", "src/pkg/msg/_State.py": SERIALIZED, "src/pkg/msg/_Other.py": SERIALIZED}
    workspace.package(files, ros=1)
    assert told(workspace, "LNT011") == 1


def test_a_class_may_be_exported_for_two_bases(workspace: Workspace) -> None:
    """LNT009: a description that names either is right."""
    build = "add_library(arm a.cpp)\npluginlib_export_plugin_description_file(core plugins.xml)\n"
    files = {"a.cpp": EXPORTS, "CMakeLists.txt": build}
    for base, expected in (("core::Base", 0), ("flow::Base", 0), ("flow::Other", 1)):
        workspace.package({**files, "plugins.xml": PLUGIN.format(base)})
        assert told(workspace, "LNT009") == expected, base


def test_a_library_that_was_not_read_may_export_the_class(workspace: Workspace) -> None:
    """LNT009: sources of tests are not read, so a class that a description gives to their library is not missing."""
    build = "add_library(arm a.cpp)\n{0}pluginlib_export_plugin_description_file(core plugins.xml)\n"
    other = PLUGIN.format("core::Base").replace("pkg::A", "pkg::B")
    files = {"a.cpp": EXPORTS, "test/b.cpp": "", "plugins.xml": other}
    workspace.package({**files, "CMakeLists.txt": build.format("")})
    assert told(workspace, "LNT009") == 1
    named = other.replace('path="arm"', 'path="more"')
    workspace.package({**files, "plugins.xml": named, "CMakeLists.txt": build.format("add_library(more test/b.cpp)\n")})
    assert told(workspace, "LNT009") == 0


OLD_ELSE = """project(pkg)
set(WITH_GPU false)
if(WITH_GPU)
  add_executable(render gpu.cpp)
else(WITH_GPU)
  add_executable({0} cpu.cpp)
endif(WITH_GPU)
catkin_package()
"""
STARTS = '<launch><node pkg="pkg" type="render" name="render"/></launch>'


def test_an_else_may_repeat_the_condition(workspace: Workspace) -> None:
    """LNT003: what CMake builds below `else(CONDITION)` is built where the condition does not hold."""
    files = {"launch/a.launch": STARTS, "gpu.cpp": "", "cpu.cpp": ""}
    workspace.package({**files, "CMakeLists.txt": OLD_ELSE.format("render")}, ros=1)
    assert told(workspace, "LNT003") == 0
    workspace.package({**files, "CMakeLists.txt": OLD_ELSE.format("renderer")}, ros=1)
    assert told(workspace, "LNT003") == 1


PARAMETER = '<launch><node pkg="pkg" type="arm" name="arm"><param name="{0}" value="1"/></node></launch>'
READS = """#include <ros/ros.h>
int main(int c, char** v) {
  ros::init(c, v, "arm");
  ros::NodeHandle n("~");
  int rate = 0;
  n.getParam("update_rate", rate);
  ros::spin();
}
"""


def test_roslaunch_strips_names_of_parameters(workspace: Workspace) -> None:
    """LNT005: white space around a name is not part of it."""
    build = "project(pkg)\nadd_executable(arm arm.cpp)\ncatkin_package()\n"
    for name, expected in (("update_rate ", 0), ("update_rates", 1)):
        files = {"launch/a.launch": PARAMETER.format(name), "arm.cpp": READS, "CMakeLists.txt": build}
        workspace.package(files, ros=1)
        assert told(workspace, "LNT005") == expected, name
