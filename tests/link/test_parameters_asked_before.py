"""Where a parameter is a text for sure, since a run asked for that before, names made of it have that text."""

from __future__ import annotations

from typing import Any

import pytest

HEAD = """
#include <ros/ros.h>
#include <std_msgs/String.h>
using std_msgs::String;
struct A {
  A(ros::NodeHandle& nh) { nh.getParam("kind", kind_); }
  std::string kind() { return kind_; }
  std::string kind_;
};
int main(int argc, char** argv) {
  ros::init(argc, argv, "driver");
  ros::NodeHandle nh, left("left"), right("right");
  std::string mode, other, side;
  A a(nh);
"""
PYTHON = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.declare_parameter("mode", "a")
        mode = self.get_parameter("mode").value
        {body}

def main():
    rclpy.init()
    rclpy.spin(Driver())
"""
SETUP = """
from setuptools import setup
setup(name="pkg", packages=["pkg"], entry_points={"console_scripts": ["driver = pkg.driver:main"]})
"""
BUILD = "find_package(catkin REQUIRED COMPONENTS roscpp)\nadd_executable(driver src/driver.cpp)\n"
MODE = 'nh.getParam("mode", mode);'
OTHER = 'nh.getParam("other", other);'


def published(workspace: Any, files: dict[str, str], ros: int = 2) -> set[tuple[str, str]]:
    found = workspace.package(files, ros=ros).modules().values()
    return {(each.name, each.confidence) for module in found for each in module.signature.interfaces if each.row.writes}


@pytest.mark.parametrize(
    ("body", "name", "confidence"),
    [
        (f'{MODE} if (mode == "gui") nh.advertise<String>("/" + mode + "/a", 1);', "/gui/a", "folded"),
        (f'{MODE} if ("gui" == mode) nh.advertise<String>("/" + mode + "/a", 1);', "/gui/a", "folded"),
        (f'{MODE} if (mode != "gui") return 1; nh.advertise<String>("/" + mode + "/a", 1);', "/gui/a", "folded"),
        (f'{MODE} if (!(mode == "gui")) return 1; nh.advertise<String>("/" + mode, 1);', "/gui", "folded"),
        (
            f'{MODE} {OTHER} if (mode == "gui" && other == "x") nh.advertise<String>("/" + mode + other, 1);',
            "/guix",
            "folded",
        ),
        (f'{MODE} side = mode + "_s"; if (mode == "gui") nh.advertise<String>("/" + side, 1);', "/gui_s", "folded"),
        ('if (a.kind() == "gui") nh.advertise<String>("/" + a.kind() + "/a", 1);', "/gui/a", "folded"),
        (f'{MODE} {OTHER} if (mode == "gui") nh.advertise<String>("/" + mode + other, 1);', "/gui{other}", "pattern"),
        (f'{MODE} if (mode == "gui" || argc > 1) nh.advertise<String>("/" + mode, 1);', "/{mode}", "pattern"),
        (f'{MODE} if (mode != "gui") nh.advertise<String>("/" + mode, 1);', "/{mode}", "pattern"),
        (f'{MODE} {OTHER} if (mode == other) nh.advertise<String>("/" + mode, 1);', "/{mode}", "pattern"),
        (
            f'{MODE} if (mode == "gui") {{ mode = "x"; nh.advertise<String>("/" + mode, 1); }}',
            "/x",
            "folded",
        ),
        (
            'left.getParam("m", mode); right.getParam("m", other); if (mode == "a") nh.advertise<String>("/" + other, 1);',
            "/{m}",
            "pattern",
        ),
    ],
)
def test_names_behind_a_test(workspace: Any, body: str, name: str, confidence: str) -> None:
    """A hole stood where a reader sees the text; what another parameter of the name is, or another text, stays open."""
    files = {"src/driver.cpp": f"{HEAD}  {body}\n  ros::spin();\n}}\n", "CMakeLists.txt": BUILD}
    assert published(workspace, files, ros=1) == {(name, confidence)}


@pytest.mark.parametrize(
    ("body", "names"),
    [
        ('if mode == "gui": self.create_publisher(String, mode + "/x", 1)', {("/gui/x", "folded")}),
        ('if mode != "gui": self.create_publisher(String, mode + "/x", 1)', {("/a/x", "default")}),
    ],
)
def test_names_behind_a_test_of_python(workspace: Any, body: str, names: set[tuple[str, str]]) -> None:
    """The default of a parameter that surely is something else was a hole; on the other side it counts."""
    files = {"pkg/__init__.py": "", "pkg/driver.py": PYTHON.replace("{body}", body), "setup.py": SETUP}
    assert published(workspace, files) == names
