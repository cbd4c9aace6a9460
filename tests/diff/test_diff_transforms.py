"""Transforms that a release no longer sends."""

from __future__ import annotations

import pytest
from diff_repos import package

MAKE = "project(arm)\ninstall(PROGRAMS scripts/arm.py scripts/more.py DESTINATION lib/arm)\n"
SENDS = """#!/usr/bin/env python3
import rclpy
from rclpy.node import Node
from geometry_msgs.msg import TransformStamped
from tf2_ros import TransformBroadcaster
class Arm(Node):
    def __init__(self):
        super().__init__('arm')
        self.sender = TransformBroadcaster(self)
        self.create_timer(1.0, self.send)
    def send(self):
        message = TransformStamped()
        message.header.frame_id = 'base'
        message.child_frame_id = {child}
        self.sender.sendTransform(message)
rclpy.init()
rclpy.spin(Arm())
"""
SILENT = SENDS.replace("self.sender.sendTransform(message)", "pass").replace("TransformBroadcaster(self)", "None")
KEPT = SENDS.replace("self.sender.sendTransform(message)", "self.more(message)")
ROBOT = '<robot name="arm"><link name="tool"/></robot>\n'
LAUNCH = '<launch><node pkg="tf2_ros" exec="static_transform_publisher" name="s" args="{}"/></launch>\n'
GONE = ("frame", "removed", "tool", None)


@pytest.mark.parametrize(
    ("new", "is_gone"),
    [
        ({"arm/scripts/arm.py": SILENT}, True),
        ({"arm/scripts/arm.py": SENDS.replace("'base'", "'other'")}, False),
        ({"arm/scripts/arm.py": KEPT}, False),
        ({"arm/scripts/arm.py": SILENT, "arm/scripts/more.py": SENDS}, False),
        ({"arm/scripts/arm.py": SENDS.replace("{child}", "self.get_name()")}, False),
        ({"arm/scripts/arm.py": SILENT, "arm/urdf/arm.urdf": ROBOT}, False),
        ({"arm/scripts/arm.py": SILENT, "arm/launch/a.launch.xml": LAUNCH}, False),
    ],
)
def test_a_frame_that_no_program_sends_any_more(told, new: dict[str, str], is_gone: bool) -> None:  # type: ignore[no-untyped-def]
    """Who looks it up waits; one that others send, or somebody whose frames are not known, may be there."""
    after = {path: text.replace("{child}", "'tool'") for path, text in new.items()}
    old = {"arm/package.xml": package("arm"), "arm/CMakeLists.txt": MAKE}
    found = told({**old, "arm/scripts/arm.py": SENDS.replace("{child}", "'tool'")}, after)
    assert (GONE in found) is is_gone
    assert not [each for each in found if "<*>" in each]
