"""Rows that nobody has thought of: a channel that ships light, and packages that use it."""

from __future__ import annotations

from pathlib import Path
from typing import Final

ROWS: Final = {
    "ecm_checker/hub/roles.toml": """
[beacon_sender]
provides = "beacon"
peer = "beacon_watcher"
channel = "beacon"
sends = true
does = "lights"
verb = "lights it as"
short = "lamp"
shape = "msg"
gives = "message"
mismatch = "SIG001"
near = "SIG005"

[beacon_watcher]
peer = "beacon_sender"
channel = "beacon"
use = "watches_beacon"
joins = "sees_beacon"
does = "watches for"
verb = "watches for it as"
short = "eye"
shape = "msg"
takes = "message"
""",
    "ecm_checker/hub/kinds.toml": """
[beacon]
who = "graph"
world = "graph"
silence = "the watcher sees nothing, for ever"
gone = "gone; who watches for it sees nothing"
by_line = true
below = ["program", "module"]
written_in = ["cpp"]

[panel]
who = "config"
world = "package"
silence = "the panel stays dark"
gone = "gone; who has it sees nothing"
holds = true

[knob]
who = "config"
world = "package"
silence = "the knob turns nothing"
gone = "gone; who turns it turns nothing"
part = true
""",
    "ecm_checker/hub/uses.toml": """
[watches_beacon]
of = ["beacon"]
names = "graph"
phrase = "watches for {name}"
breaches = ["gone", "type"]
fit = "type"
linted = true

[turns_knob]
of = ["knob"]
names = "exact"
phrase = "turns {name} of {owner}"
""",
    "ecm_checker/hub/uses_of_launches.toml": """
[sees_beacon]
of = ["beacon"]
names = "resolved"
phrase = "watches for {name}"
breaches = ["gone", "type"]
warned = false
stated = false
launched = true
fit = "type"
""",
    "ecm_extract/link/declaring/forms/beacon.toml": """
[[form]]
callee = "light_beacon"
role = "beacon_sender"
ros = 2
name = "arg:0"
type = "template:0"

[[form]]
callee = "watch_beacon"
role = "beacon_watcher"
ros = 2
name = "arg:0"
type = "template:0"
""",
}
"""What is added to each table; no other file differs."""

_MANIFEST: Final = """<package format="3"><name>{name}</name><version>1.0.0</version><description>d</description>
<maintainer email="a@example.org">a</maintainer><license>MIT</license><buildtool_depend>ament_cmake</buildtool_depend>
<depend>rclcpp</depend><depend>std_msgs</depend><exec_depend>tower</exec_depend>
<export><build_type>ament_cmake</build_type></export></package>
"""
_BUILD: Final = """cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
find_package(std_msgs REQUIRED)
add_executable({name}_node src/{name}.cpp)
ament_target_dependencies({name}_node rclcpp std_msgs)
install(TARGETS {name}_node DESTINATION lib/${{PROJECT_NAME}})
install(DIRECTORY launch DESTINATION share/${{PROJECT_NAME}})
ament_package()
"""
_SOURCE: Final = """#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>

class {name}Node : public rclcpp::Node {{
 public:
  {name}Node() : Node("{name}") {{
    light_ = {call};
  }}
}};

int main(int argc, char** argv) {{
  rclcpp::init(argc, argv);
  rclcpp::spin(std::make_shared<{name}Node>());
}}
"""
_LAUNCH: Final = """from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([
        Node(package="tower", executable="tower_node"),
        Node(package="ship", executable="ship_node"),
    ])
"""
LAUNCH: Final = "ship/launch/both.launch.py"


def write_tower(root: Path, name: str, kind: str = "String") -> Path:
    """Write a package that lights a beacon of a name and type."""
    return _write(root, "tower", f'light_beacon<std_msgs::msg::{kind}>("{name}")')


def write_ship(root: Path, name: str) -> Path:
    """Write a package that watches for a beacon, with a launch file that starts it and the tower."""
    return _write(root, "ship", f'watch_beacon<std_msgs::msg::String>("{name}")')


def _write(root: Path, name: str, call: str) -> Path:
    files = {
        "package.xml": _MANIFEST.format(name=name) if name == "ship" else _MANIFEST.format(name=name).replace(_ON, ""),
        "CMakeLists.txt": _BUILD.format(name=name),
        f"src/{name}.cpp": _SOURCE.format(name=name, call=call),
        "launch/both.launch.py": _LAUNCH if name == "ship" else "",
    }
    for path, text in files.items():
        target = root / name / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text, "utf-8")
    return root


_ON: Final = "<exec_depend>tower</exec_depend>"
