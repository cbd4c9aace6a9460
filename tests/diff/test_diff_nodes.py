"""Nodes that are called otherwise, and who names them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from diff_repos import node, package, release, write

from ecm_extract.cli.run import run

CMAKE = "project(arm)\nadd_executable(arm src/arm.cpp)\ninstall(TARGETS arm DESTINATION lib/arm)\n"
ROS1 = package("arm").replace("ament_cmake", "catkin").replace("rclcpp", "roscpp")
PROGRAM = """#include <ros/ros.h>
#include <std_msgs/Bool.h>
int main(int c, char ** v) { ros::init(c, v, "%s"); ros::NodeHandle nh; nh.advertise<std_msgs::Bool>("done", 1); }
"""
SCRIPT = """#!/usr/bin/env python3
import rclpy
from std_msgs.msg import Bool
rclpy.init()
node = rclpy.create_node('%s')
node.create_publisher(Bool, 'done', 1)
"""
LAUNCH = '<launch>\n<node pkg="arm" exec="arm" name="%s"/>\n<node pkg="leg" exec="leg" name="leg"/>\n</launch>\n'


def arm(name: str, *lines: str) -> str:
    """The node of the test under a name."""
    return node(*lines).replace('"arm"', f'"{name}"')


@pytest.mark.parametrize(
    ("path", "text"),
    [
        ("src/arm.cpp", arm("%s")),
        ("src/main.cpp", PROGRAM),
        ("scripts/arm.py", SCRIPT),
        ("launch/arm.launch.xml", LAUNCH),
    ],
)
def test_a_node_is_renamed(told, path: str, text: str) -> None:  # type: ignore[no-untyped-def]
    """By its constructor, its initialisation or its launch file; what it offers is where it was."""
    make = CMAKE.replace("src/arm.cpp", path) if path.startswith("src") else "project(arm)\n"
    if path.startswith("scripts"):
        make += "install(PROGRAMS scripts/arm.py DESTINATION lib/arm)\n"
    manifest = ROS1 if "ros/ros.h" in text else package("arm")
    old = {"arm/package.xml": manifest, "arm/CMakeLists.txt": make, f"arm/{path}": text.replace("%s", "arm_driver")}
    found = told(
        old,
        {f"arm/{path}": text.replace("%s", "arm")},
    )
    assert found == {("node", "renamed", "arm_driver", "arm")}


def test_what_a_renamed_node_offers_stays(told) -> None:  # type: ignore[no-untyped-def]
    """One cause, one change: its topics and parameters have the same names below it."""
    lines = ('declare_parameter("rate", 1);', 'create_publisher<std_msgs::msg::Bool>("~/done", 1);')
    old = {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": arm("arm_driver", *lines)}
    assert told(old, {"arm/src/arm.cpp": arm("arm", *lines)}) == {("node", "renamed", "arm_driver", "arm")}


def test_a_computed_name_is_not_gone(told) -> None:  # type: ignore[no-untyped-def]
    """What cannot be read is no change."""
    old = {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": arm("arm_driver")}
    new = arm("x").replace('Node("x")', "Node(name())")
    assert told(old, {"arm/src/arm.cpp": new}) == set()


def test_a_launch_file_that_starts_another_program(told) -> None:  # type: ignore[no-untyped-def]
    """Another node, not another name."""
    new = LAUNCH.replace("%s", "hand").replace('exec="arm"', 'exec="hand"')
    found = told({"arm/launch/arm.launch.xml": LAUNCH.replace("%s", "arm")}, {"arm/launch/arm.launch.xml": new})
    assert [entry for entry in found if entry[0] == "node"] == [("node", "removed", "arm", None)]


POLICY = """<policy version="0.2.0"><enclaves><enclave path="/"><profiles>
<profile ns="/" node="arm_driver"><topics publish="ALLOW"><topic>done</topic></topics></profile>
</profiles></enclave></enclaves></policy>
"""
USERS = {
    "config/arm.yaml": ("/left:\n  arm_driver:\n    ros__parameters:\n      rate: 2\n", [2]),
    "config/managed.yaml": ("m:\n  ros__parameters:\n    node_names: [leg, arm_driver]\n", [3]),
    "config/policy.xml": (POLICY, [2]),
    "config/other.yaml": ("leg:\n  ros__parameters:\n    arm_driver: 2\n", []),
    "launch/remap.launch.xml": (
        '<launch>\n<node pkg="leg" exec="leg" name="leg">\n<remap from="a" to="/arm_driver/a"/></node>\n</launch>\n',
        [3],
    ),
    "launch/keeps.launch.xml": ('<launch>\n<node pkg="arm" exec="arm" name="arm_driver"/>\n</launch>\n', []),
}


def _findings(capsys: pytest.CaptureFixture[str], repo: Path, user: Path) -> list[dict[str, Any]]:
    run(["diff", "1.0.0", "2.0.0", "--repo", str(repo), "--consumer", str(user), "--format", "json", "--no-cache"])
    found: list[dict[str, Any]] = json.loads(capsys.readouterr().out)["findings"]
    return found


@pytest.mark.parametrize("path", USERS)
def test_who_names_a_renamed_node(tmp_path: Path, capsys: pytest.CaptureFixture[str], path: str) -> None:
    """Parameter files, lists of managed nodes, policies and remaps break on their lines."""
    repo, user = tmp_path / "arm", tmp_path / "user"
    for tag, name in (("1.0.0", "arm_driver"), ("2.0.0", "arm")):
        release(repo, {"package.xml": package("arm", tag), "CMakeLists.txt": CMAKE, "src/arm.cpp": arm(name)}, tag)
    text, lines = USERS[path]
    write(user, {"package.xml": package("user"), path: text})
    found = _findings(capsys, repo, user)
    assert [each["line"] for entry in found for each in entry["evidence"] if each["path"] == path] == lines


def test_a_launch_file_that_gives_the_old_name_keeps_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Whatever the program calls itself, its parameters reach it."""
    repo, user = tmp_path / "arm", tmp_path / "user"
    for tag, name in (("1.0.0", "arm_driver"), ("2.0.0", "arm")):
        release(repo, {"package.xml": package("arm", tag), "CMakeLists.txt": CMAKE, "src/arm.cpp": arm(name)}, tag)
    files = {path: USERS[path][0] for path in ("config/arm.yaml", "launch/keeps.launch.xml")}
    write(user, {"package.xml": package("user"), **files})
    assert _findings(capsys, repo, user) == []


PRIVATE = """#!/usr/bin/env python
import rospy
from std_msgs.msg import Bool
rospy.init_node('arm')
rate = rospy.get_param('~%s', 10)
rospy.Publisher('done', Bool, queue_size=1)
"""
PORTED = """#!/usr/bin/env python3
import rclpy
from std_msgs.msg import Bool
node = rclpy.create_node('arm')
rate = node.declare_parameter('%s', 10)
node.create_publisher(Bool, 'done', 1)
"""


@pytest.mark.parametrize(("old", "new"), [("rate", "rate"), ("turbo/rate", "turbo.rate")])
def test_a_private_parameter_of_ros_1_is_one_of_the_node_in_ros_2(told, old: str, new: str) -> None:  # type: ignore[no-untyped-def]
    """A port renames none of them."""
    make = "project(arm)\ninstall(PROGRAMS scripts/arm.py DESTINATION lib/arm)\n"
    before = {"arm/package.xml": ROS1, "arm/CMakeLists.txt": make, "arm/scripts/arm.py": PRIVATE % old}
    found = told(before, {"arm/package.xml": package("arm"), "arm/scripts/arm.py": PORTED % new})
    assert not [entry for entry in found if entry[0] == "parameter"]


def test_a_package_is_renamed_and_what_its_nodes_offer_stays(told) -> None:  # type: ignore[no-untyped-def]
    """Names in the graph know of no package."""
    source = arm("arm", 'declare_parameter("rate", 1);', 'create_publisher<std_msgs::msg::Bool>("done", 1);')
    old = {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": source, "arm/README.md": "the arm\n"}
    moved = {path.replace("arm/", "hand/", 1): text for path, text in old.items()}
    new = {"hand/package.xml": package("hand"), **moved, **dict.fromkeys(old), "arm/package.xml": None}
    assert ("package", "renamed", "arm", "hand") in (found := told(old, new))
    assert not [entry for entry in found if entry[0] in {"topic", "parameter", "node"}]


def test_what_goes_with_a_node_is_folded_below_it(changes) -> None:  # type: ignore[no-untyped-def]
    """One row for a program that is gone; its node, topics and parameters name it as their cause."""
    lines = ('declare_parameter("rate", 1);', 'create_publisher<std_msgs::msg::Bool>("done", 1);')
    found = changes(
        {"arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": arm("arm", *lines)},
        {"arm/CMakeLists.txt": "project(arm)\n", "arm/src/arm.cpp": None},
    )
    assert {(each["kind"], each["cause"]) for each in found} == {
        ("executable", None),
        ("node", "executable arm of arm"),
        ("topic", "executable arm of arm"),
        ("parameter", "executable arm of arm"),
    }


def test_a_header_that_is_gone_explains_its_classes(changes) -> None:  # type: ignore[no-untyped-def]
    """One row for the header."""
    old = {"arm/include/arm/arm.hpp": "#pragma once\nnamespace arm {\nclass Arm { public: void move(); };\n}\n"}
    found = changes(old, dict.fromkeys(old))
    assert {(each["kind"], each["cause"]) for each in found} == {
        ("file", None),
        ("class", "file arm/arm.hpp of arm"),
    }


@pytest.mark.parametrize(("before", "breaks"), [("double", False), ("std::string", True)])
def test_a_parameter_that_is_read_as_two_types_has_both(told, before: str, breaks: bool) -> None:  # type: ignore[no-untyped-def]
    """Who sets it as the old type is still understood."""
    one = 'int main(int c, char ** v) { ros::init(c, v, "arm"); ros::NodeHandle nh("~"); %s }\n'
    read = {each: f'{each} {each[0]}; nh.param<{each}>("rate", {each[0]}, {{}});' for each in ("int", "double")}
    read["std::string"] = 'std::string s; nh.param<std::string>("rate", s, "");'
    source = "#include <ros/ros.h>\n" + one
    old = {"arm/package.xml": ROS1, "arm/CMakeLists.txt": CMAKE, "arm/src/arm.cpp": source % read[before]}
    found = told(old, {"arm/src/arm.cpp": source % f"{read['int']} {read['double']}"})
    assert bool({each for each in found if each[:2] == ("parameter", "type_changed")}) is breaks


def test_values_and_launched_nodes_of_a_renamed_package_stay(told) -> None:  # type: ignore[no-untyped-def]
    """Values go with their file, and a node has its name in the graph: what moved are the files that give them."""
    make = "project(arm)\ninstall(DIRECTORY config launch DESTINATION share/arm)\n"
    launch = "<launch><node pkg='tools' exec='bar' name='bar'/></launch>\n"
    values = "bar:\n  ros__parameters:\n    rate: %d\n    gain: 3\n"
    old = {"arm/CMakeLists.txt": make, "arm/config/bar.yaml": values % 2, "arm/launch/bar.launch.xml": launch}
    new = {path.replace("arm/", "hand/", 1): text for path, text in old.items()}
    new |= {"hand/config/bar.yaml": values % 5, "hand/CMakeLists.txt": make.replace("arm", "hand")}
    found = told(old, {"hand/package.xml": package("hand"), **new, **dict.fromkeys(old), "arm/package.xml": None})
    settings = {(change, name) for kind, change, name, _ in found if kind == "parameter_setting"}
    assert settings == {("default_changed", "bar.rate")}
    assert ("launch_file", "moved", "arm: bar.launch.xml", "hand: bar.launch.xml") in found
    assert not [each for each in found if each[0] == "node"]
