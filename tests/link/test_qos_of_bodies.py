"""Profiles of which the body of a module, or of a class, sets fields."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String
MODULE = QoSProfile(depth=1)
MODULE.durability = DurabilityPolicy.TRANSIENT_LOCAL
class Demo(Node):
    CLASS = QoSProfile(depth=2)
    CLASS.durability = DurabilityPolicy.TRANSIENT_LOCAL
    PLAIN = QoSProfile(depth=3)
    def __init__(self):
        super().__init__("demo")
        self.create_publisher(String, "chatter", {profile})
"""


@pytest.mark.parametrize(
    ("profile", "durability", "depth"),
    [
        ("MODULE", "transient_local", 1),
        ("self.CLASS", "transient_local", 2),
        ("Demo.CLASS", "transient_local", 2),
        ("self.PLAIN", "volatile", 3),
    ],
)
def test_a_profile_has_what_its_body_sets(workspace: Any, profile: str, durability: str, depth: int) -> None:
    """A field that is set behind the profile counts, and it was told as the profile was made."""
    workspace.package({"pkg/demo.py": NODE.format(profile=profile)})
    qos = workspace.only("publisher").qos
    assert (qos.durability, qos.depth) == (durability, depth)
