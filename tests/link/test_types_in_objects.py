"""Types of endpoints of Python that stand in objects, by who makes those."""

from __future__ import annotations

from typing import Any

import pytest

INNER = """#!/usr/bin/env python
import rospy
from std_msgs.msg import *
from geometry_msgs.msg import Pose

class Robot:
    _core = "/core"

    def __init__(self):
        topics = [("/left", geometry_msgs.msg.Wrench), (self._core + "/right", geometry_msgs.msg.Wrench)]
        self.kept = {{}}
        for name, kind in topics:
            self.kept[name] = {maker}(name, kind)

    class Kept:
        def __init__(self, name, kind):
            self.sub = rospy.Subscriber(name, kind, self.take)

        def take(self, message):
            pass

if __name__ == "__main__":
    rospy.init_node("n")
    Robot()
"""


@pytest.mark.parametrize("maker", ["Robot.Kept", "self.Kept"])
def test_a_class_within_a_class_is_made_by_its_name(workspace: Any, maker: str) -> None:
    """Who makes its objects knows names and types; a package that a star may bind is spelled out."""
    workspace.package({"scripts/n.py": INNER.format(maker=maker)}, ros=1)
    found = {entry.name: entry.type for entry in workspace.interfaces() if entry.role == "subscriber"}
    assert found == {"/left": "geometry_msgs/msg/Wrench", "/core/right": "geometry_msgs/msg/Wrench"}


KINDS = """
import rospy
import other.msg

class Kinds:
    def __init__(self, one=None, two=None):
        self.one = one
        self.two = two

class Part:
    def __init__(self, kinds, name):
        self.kinds = kinds
        self.name = name
        self.start()

    def start(self):
        if self.kinds.one is not None:
            self.sub = rospy.Subscriber(self.name, self.kinds.one, self.take)

    def take(self, message):
        pass

class Further(Part):
    def __init__(self, kinds, name):
        kinds.{changed}
        super(Further, self).__init__(kinds=kinds, name=name)

class Robot:
    def __init__(self):
        self.left = Kinds(one=other.msg.Left)
        self.part = Part(self.left, "left")
        self.right = Kinds(one=other.msg.Right, two=other.msg.Left)
        self.further = Further(kinds=self.right, name="right")

if __name__ == "__main__":
    rospy.init_node("n")
    Robot()
"""


@pytest.mark.parametrize(
    ("changed", "left", "right"),
    [
        ("two = None", "other/msg/Left", "other/msg/Right"),
        ("two = other.msg.Third", "other/msg/Left", "other/msg/Right"),
        ("one = other.msg.Third", None, None),
    ],
)
def test_a_type_in_a_field_of_an_object_that_is_handed_on(
    workspace: Any, changed: str, left: str | None, right: str | None
) -> None:
    """It is what that object was made with, unless others give such a field something that is a type."""
    workspace.package({"scripts/n.py": KINDS.format(changed=changed)}, ros=1)
    found = {entry.name: entry.type for entry in workspace.interfaces() if entry.role == "subscriber"}
    assert found == {"/left": left, "/right": right}


def test_a_field_that_others_only_empty_has_the_type_that_it_was_made_with(workspace: Any) -> None:
    """`None` is no type that an endpoint is made with."""
    workspace.package({"scripts/n.py": KINDS.format(changed="one = None")}, ros=1)
    found = {entry.name: entry.type for entry in workspace.interfaces() if entry.role == "subscriber"}
    assert found["/left"] == "other/msg/Left"
