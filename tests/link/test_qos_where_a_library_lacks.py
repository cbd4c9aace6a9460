"""Profiles by names that a file imports, and that are None where there is no such library: Python."""

from __future__ import annotations

from typing import Any

import pytest

CODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
{imports}
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        {body}
def main():
    rclpy.spin(Demo())
"""
LACKING = """
try:
    from rclpy.qos import QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
except ImportError:
    QoSProfile = ReliabilityPolicy = None
    qos_profile_sensor_data = {instead}
"""
OWN = "QoSProfile(depth=2, reliability=ReliabilityPolicy.BEST_EFFORT)"
ROWS = {
    "a policy": ("None", OWN, "best_effort", 2),
    "a preset": ("None", "qos_profile_sensor_data", "best_effort", 5),
    "a preset, or a number": ("3", "qos_profile_sensor_data", "unknown", None),
}


@pytest.mark.parametrize(("instead", "profile", "reliability", "depth"), ROWS.values(), ids=ROWS)
def test_none_is_no_profile(workspace: Any, instead: str, profile: str, reliability: str, depth: int) -> None:
    """Nobody makes an endpoint with None: what the import gives is the profile; another one leaves it open."""
    text = CODE.format(imports=LACKING.format(instead=instead), body=f'self.create_publisher(String, "a", {profile})')
    (one,) = [one for one in workspace.package({"demo.py": text}).interfaces() if one.role == "publisher"]
    assert one.qos.reliability == reliability or one.qos.depth != 5
    assert reliability == "unknown" or (one.qos.reliability, one.qos.depth) == (reliability, depth)
    assert depth is not None or one.qos.reliability != "best_effort"


KEPT = """
from rclpy.qos import QoSProfile, ReliabilityPolicy
class Fast:
    qos = QoSProfile(depth=2, reliability=ReliabilityPolicy.BEST_EFFORT)
class Slow:
    qos = QoSProfile(depth=7)
class Channel:
    def __init__(self, node, settings):
        self.settings = settings
        node.create_publisher(String, "b/" + settings.__name__, self.settings.qos)
"""


def test_a_class_that_is_kept_has_its_profile(workspace: Any) -> None:
    """A constructor that keeps the class that it is handed has the profile of that class."""
    text = CODE.format(imports=KEPT, body="Channel(self, Fast), Channel(self, Slow)")
    found = workspace.package({"demo.py": text}).interfaces()
    told = {str(one.name): (one.qos.reliability, one.qos.depth) for one in found if one.role == "publisher"}
    assert (told["/b/Fast"], told["/b/Slow"]) == (("best_effort", 2), ("reliable", 7))
