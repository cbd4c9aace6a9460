"""Nodes of a system as its processes make them: what a manager hosts, and what parameters tell apart."""

from __future__ import annotations

from pathlib import Path

import pytest

from ecm_extract.extraction_model import Options
from ecm_extract.system.connections import connections
from ecm_extract.system.model import Given
from ecm_extract.system.system import System, read_system
from ecm_extract.tree import open_tree

LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    share = get_package_share_directory('p')
    description = {'robot_description': Command(['xacro ', share, '/robot.urdf'])}
    manager = Node(
        package='controller_manager', executable='ros2_control_node', parameters=[description, share + '/c.yaml'],
        remappings=[('base/cmd_vel_unstamped', 'cmd_vel'), ('base:~/odom', 'wheels'), ('driver/stop', 'stop')])
    spawner = Node(package='controller_manager', executable='spawner', arguments=['base'])
    return LaunchDescription([manager, spawner])
"""
PARAMETERS = """
controller_manager:
  ros__parameters:
    base: {type: diff_drive_controller/DiffDriveController}
base:
  ros__parameters: {use_stamped_vel: false}
"""
ROBOT = """<robot name='r'><link name='base_link'/>
<ros2_control name='Driver' type='system'><hardware><plugin>p/Driver</plugin></hardware></ros2_control></robot>
"""
DRIVER = """
#include <hardware_interface/system_interface.hpp>
#include <std_msgs/msg/bool.hpp>
namespace p {
class Driver : public hardware_interface::SystemInterface {
  hardware_interface::CallbackReturn on_init(const hardware_interface::HardwareInfo &) override {
    node_ = std::make_shared<rclcpp::Node>("driver");
    stop_ = node_->create_publisher<std_msgs::msg::Bool>("~/stop", 1);
    return hardware_interface::CallbackReturn::SUCCESS;
  }
  rclcpp::Node::SharedPtr node_;
  rclcpp::Publisher<std_msgs::msg::Bool>::SharedPtr stop_;
};
}
PLUGINLIB_EXPORT_CLASS(p::Driver, hardware_interface::SystemInterface)
"""
PLUGIN = """<library path='p'><class name='p/Driver' type='p::Driver'
base_class_type='hardware_interface::SystemInterface'/></library>
"""
BUILD = """project(p)
add_library(p SHARED src/driver.cpp)
pluginlib_export_plugin_description_file(hardware_interface plugins.xml)
"""
MANIFEST = "<package format='3'><name>p</name><version>1.0.0</version><export><build_type>ament_cmake</build_type></export></package>"


LISTS = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/bool.hpp>
struct First {
  explicit First(rclcpp::Node & node) {
    auto topics = node.declare_parameter("first", std::vector<std::string>());
    for (const auto & topic : topics) { subs.push_back(node.create_subscription<std_msgs::msg::Bool>(topic, 1, cb)); }
  }
};
struct Second {
  explicit Second(rclcpp::Node & node) {
    auto topics = node.declare_parameter("second", std::vector<std::string>());
    for (const auto & topic : topics) { subs.push_back(node.create_subscription<std_msgs::msg::Bool>(topic, 1, cb)); }
  }
};
class Inputs : public rclcpp::Node {
public:
  Inputs() : Node("inputs"), first(*this), second(*this) {}
  First first;
  Second second;
};
int main() { rclcpp::spin(std::make_shared<Inputs>()); }
"""


def written(folder: Path, files: dict[str, str]) -> System:
    for name, text in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    return read_system(open_tree(str(folder)), ["a.launch.py"], Given(), Options(jobs=1, cache=False))


def system(folder: Path) -> System:
    files = {
        "package.xml": MANIFEST,
        "a.launch.py": LAUNCH,
        "c.yaml": PARAMETERS,
        "robot.urdf": ROBOT,
        "src/driver.cpp": DRIVER,
        "plugins.xml": PLUGIN,
        "CMakeLists.txt": BUILD,
    }
    return written(folder, files)


def test_remaps_of_the_manager_reach_what_it_hosts(tmp_path: Path) -> None:
    """A controller listens under the name that its manager was given, and a driver of the tree is in the graph."""
    found = {node.name: {entry.name for entry in node.endpoints} for node in system(tmp_path).nodes}
    assert {"/cmd_vel", "/wheels"} <= found["/base"]
    assert found["/driver"] == {"/stop"}


def test_every_parameter_file_of_a_simulator_plugin_is_read(tmp_path: Path) -> None:
    """The last one holds often nothing but `use_sim_time`."""
    plugin = "<gazebo><plugin name='c' filename='libgazebo_ros2_control.so'>{}</plugin></gazebo></robot>".format(
        "".join(f"<parameters>$(find p)/{name}.yaml</parameters>" for name in ("c", "late"))
    )
    files = {
        "package.xml": MANIFEST,
        "a.launch.py": LAUNCH.replace("parameters=[description, share + '/c.yaml'],", "parameters=[description],"),
        "c.yaml": PARAMETERS,
        "late.yaml": "controller_manager:\n  ros__parameters: {use_sim_time: true}\n",
        "robot.urdf": ROBOT.replace("</robot>", plugin),
    }
    (controller,) = written(tmp_path, files).controllers
    assert controller.type == "diff_drive_controller/DiffDriveController"


def test_endpoints_that_only_their_parameters_tell_apart(tmp_path: Path) -> None:
    """Two lists of topics of one type are two sets of subscriptions."""
    given = "parameters=[{'first': ['a'], 'second': ['b', 'c']}]"
    launch = f"def generate_launch_description():\n    return LaunchDescription([Node(package='p', executable='inputs', {given})])\n"
    cmake = "project(p)\nadd_executable(inputs src/inputs.cpp)\n"
    files = {"package.xml": MANIFEST, "a.launch.py": launch, "src/inputs.cpp": LISTS, "CMakeLists.txt": cmake}
    (node,) = written(tmp_path, files).nodes
    assert sorted(entry.name for entry in node.endpoints) == ["/a", "/b", "/c"]


def test_what_hosts_the_unknown_leaves_the_rest_open(tmp_path: Path) -> None:
    """A driver whose source is elsewhere may have endpoints; one of the tree is known."""
    assert system(tmp_path / "known").unknown == frozenset()
    files = {"package.xml": MANIFEST, "a.launch.py": LAUNCH, "c.yaml": PARAMETERS, "robot.urdf": ROBOT}
    assert written(tmp_path / "unknown", files).unknown == {"p/Driver"}


CHAINED = """
controller_manager:
  ros__parameters:
    base: {type: forward_command_controller/ForwardCommandController}
base:
  ros__parameters: {joints: [wheels], interface_name: velocity}
"""


@pytest.mark.parametrize(("joint", "state"), [("wheels", "dangling"), ("base/wheel", "unknown")])
def test_what_another_controller_exports_is_not_missing(tmp_path: Path, joint: str, state: str) -> None:
    """The hardware tells all its interfaces, a controller none of its reference interfaces."""
    robot = ROBOT.replace(
        "</ros2_control>", "<joint name='arm'><command_interface name='effort'/></joint></ros2_control>"
    )
    files = {"package.xml": MANIFEST, "a.launch.py": LAUNCH, "c.yaml": CHAINED.replace("wheels", joint)}
    sources = {"robot.urdf": robot, "src/driver.cpp": DRIVER, "plugins.xml": PLUGIN, "CMakeLists.txt": BUILD}
    found = connections(written(tmp_path, {**files, **sources}))
    assert [(each.requirement.said, each.state) for each in found if each.requirement.use == "claims"] == [
        (f"{joint}/velocity", state)
    ]
