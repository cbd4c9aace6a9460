"""Who gives another function in the place of one that declares leaves open what a call of it does: Python."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import pytest

ROS_2 = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Other:
    pass
def given(*args): pass
{module}
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.topic = "a"
{body}
        self.create_publisher(String, self.topic, 10)
{behind}
def main():
    rclpy.spin(Demo())
"""
OPEN = {"/a", "/{create_publisher}"}
BODIES = {
    "the library's class": ("Node.create_publisher = given", "", "", OPEN),
    "the class itself": ("", "", "Demo.create_publisher = given", OPEN),
    "the object": ("", "self.create_publisher = given", "", OPEN),
    "its own class by its type": ("", "type(self).create_publisher = given", "", OPEN),
    "its own class by an attribute": ("", "self.__class__.create_publisher = given", "", OPEN),
    "by its name": ('setattr(Node, "create_publisher", given)', "", "", OPEN),
    "by any name": ('for name in ("create_publisher",):\n    setattr(Node, name, given)', "", "", OPEN),
    "of another class": ("Other.create_publisher = given", "", "", {"/a"}),
    "of another name": ("Node.create_client = given", "", "", {"/a"}),
    "another class by any name": ('setattr(Other, "create_" + "publisher", given)', "", "", {"/a"}),
    "code that is run": ("", "exec(\"self.topic = 'b'\")", "", {"/{topic}"}),
    "code that a file has": ("", "execfile('more.py')", "", {"/{topic}"}),
}


@pytest.mark.parametrize(("module", "body", "behind", "expected"), BODIES.values(), ids=BODIES)
def test_what_is_replaced_is_open(workspace: Any, module: str, body: str, behind: str, expected: set[str]) -> None:
    """The name that is written is one of several, beside one that nobody knows; near-misses are told as they stand."""
    text = ROS_2.format(module=module, body=indent(body, " " * 8), behind=behind)
    found = workspace.package({"demo.py": text}).interfaces()
    assert {one.name for one in found if one.role == "publisher"} == expected
    proved = {one.confidence for one in found if one.role == "publisher"} & {"literal", "folded"}
    assert bool(proved) == (expected == {"/a"})


ROS_1 = """#!/usr/bin/env python
import rospy
from std_msgs.msg import String
class Holder:
    pass
holder = Holder()
{module}
rospy.init_node("demo")
rospy.Publisher(rospy.get_param("~topic", "a"), String, queue_size=1)
"""
MODULES = {
    "nothing": ("", {"/a"}),
    "the class of the library": ("rospy.Publisher = print", {"/a", "/{Publisher}"}),
    "the reader of parameters": ("rospy.get_param = print", {"/{get_param}"}),
    "a member that is called like it": ("holder.Publisher = print", {"/a"}),
}


@pytest.mark.parametrize(("module", "expected"), MODULES.values(), ids=MODULES)
def test_what_a_module_has_is_replaced(workspace: Any, module: str, expected: set[str]) -> None:
    """What a module of a library has is replaced for whoever calls it."""
    found = workspace.package({"scripts/demo.py": ROS_1.format(module=module)}, ros=1).interfaces()
    assert {one.name for one in found if one.role == "publisher"} == expected
