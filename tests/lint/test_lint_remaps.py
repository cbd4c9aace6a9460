"""What a source writes, and what bases of other repositories bring, decides on a remap without effect (LNT006)."""

from __future__ import annotations

import pytest
from lint_fixtures import lint
from workspaces import Workspace

NODE = "rclcpp::Node"
ROWS = [
    ("", NODE, "", True),
    ("", NODE, 'say("in");', False),
    ("", NODE, 'say("a" "in");', True),
    ("", NODE, '// "in"\n', True),
    ("", NODE, 'say("a"in"b");', True),
    ('#include "in"', NODE, "", True),
    ('#define NAME "in"', NODE, "", False),
    ("using rclcpp::Node;", "Node", "", True),
    ("using namespace rclcpp;", "Node", "", True),
    ("", f"{NODE}, public std::enable_shared_from_this<A>", "", True),
    ("", f"{NODE}, public QObject", "", True),
    ("", f"{NODE}, public acme::DriverNode", "", False),
    ("using namespace acme;", f"{NODE}, public DriverBase", "", False),
    ("namespace acme { class DriverBase {}; }", f"{NODE}, public acme::DriverBase", "", True),
    ("", "nav2_util::LifecycleNode", "", True),
]


@pytest.mark.parametrize(("head", "base", "body", "expected"), ROWS)
def test_remaps(workspace: Workspace, head: str, base: str, body: str, expected: bool) -> None:
    """A comment uses no name, and what a base brings is known by its library, not by what it is called."""
    assert ("LNT006" in found(workspace, "in", (head, base, body))) is expected


def test_names_of_a_base(workspace: Workspace) -> None:
    """A base of a library has the names that its row has."""
    assert "LNT006" not in found(workspace, "bond", ("", "nav2_util::LifecycleNode", ""))


@pytest.mark.parametrize(("taken", "expected"), [("move_group_interface/move_group_interface.h", False), ("x.h", True)])
def test_names_of_an_object(workspace: Workspace, taken: str, expected: bool) -> None:
    """An object of a library that a source takes in has the names that its row has."""
    assert ("LNT006" in found(workspace, "joint_states", (f"#include <moveit/{taken}>", NODE, ""))) is expected


@pytest.mark.parametrize(
    ("imported", "base", "expected"),
    [
        ("import threading", "threading.Thread", True),
        ("from abc import ABC", "ABC", True),
        ("", "object", True),
        ("from acme import NodeBase", "NodeBase", False),
        ("from acme import *", "NodeBase", False),
    ],
)
def test_bases_in_python(workspace: Workspace, imported: str, base: str, expected: bool) -> None:
    """Classes of the language bring no names, those of others may."""
    made = "super().__init__('a')\n        self.create_publisher(String, 'out', 1)"
    code = (
        f"#!/usr/bin/env python3\n{imported}\nimport rclpy\nfrom rclpy.node import Node\n"
        f"from std_msgs.msg import String\n"
        f"class A(Node, {base}):\n    def __init__(self):\n        {made}\nrclpy.init()\nrclpy.spin(A())\n"
    )
    build = "install(PROGRAMS scripts/a DESTINATION lib/pkg)\n"
    files = {"scripts/a": code, "CMakeLists.txt": build, "launch/a.launch.xml": launch("in")}
    rules = [finding.rule for finding in lint(workspace.package(files, ros=2).root)]
    assert ("LNT006" in rules) is expected


def found(workspace: Workspace, name: str, parts: tuple[str, str, str]) -> list[str]:
    """The rules that a node and a launch file break which remaps a name; the parts are a head, the bases and a body."""
    head, base, body = parts
    made = f'A() : Node("a") {{ create_publisher<std_msgs::msg::String>("out", 1); {body} }}'
    main = "int main(int c, char **v) { rclcpp::init(c, v); rclcpp::spin(std::make_shared<A>()); }\n"
    files = {
        "src/a.cpp": f"{head}\nclass A : public {base} {{ public: {made} }};\n{main}",
        "CMakeLists.txt": "add_executable(a src/a.cpp)\ninstall(TARGETS a DESTINATION lib/pkg)\n",
        "launch/a.launch.xml": launch(name),
    }
    return [finding.rule for finding in lint(workspace.package(files, ros=2).root)]


def launch(name: str) -> str:
    """A launch file that remaps a name of a node."""
    return f'<launch><node pkg="pkg" exec="a"><remap from="{name}" to="x"/></node></launch>'
