"""Arguments that a base takes from attributes and methods which the classes derived from it have of their own."""

from __future__ import annotations

from typing import Any

TEXT = """
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool, String
class Base(Node):
    KIND = String
    QOS = QoSProfile(depth=1)
    LIMIT = 1
    def __init__(self, name):
        super().__init__(name)
        self.create_publisher(self.KIND, "out", self.QOS)
        self.create_subscription(String, "in", print, self.profile)
        self.declare_parameter("limit", self.LIMIT)
    @property
    def profile(self):
        return QoSProfile(depth=2)
class First(Base):
    KIND = Bool
    QOS = QoSProfile(depth=7, reliability=ReliabilityPolicy.BEST_EFFORT)
    LIMIT = 7
    def __init__(self):
        super().__init__("first")
    @property
    def profile(self):
        return QoSProfile(depth=8)
class Second(Base):
    def __init__(self):
        super().__init__("second")
def main():
    rclpy.init()
    nodes = [First(), Second()]
"""


def _told(module: Any) -> set[tuple[str, str, Any]]:
    found = module.signature.interfaces
    return {(each.name, each.type, each.qos.depth if each.qos is not None else each.default) for each in found}


def test_each_class_has_what_its_own_attributes_say(workspace: Any) -> None:
    """Type, profile and default are those of the object's class, as its name is; other classes keep the base's."""
    modules = workspace.package({"pkg/d.py": TEXT}).modules()
    assert _told(modules["ecm.pkg.first"]) == {
        ("/out", "std_msgs/msg/Bool", 7),
        ("/in", "std_msgs/msg/String", 8),
        ("limit", "integer", 7),
    }
    assert _told(modules["ecm.pkg.second"]) == {
        ("/out", "std_msgs/msg/String", 1),
        ("/in", "std_msgs/msg/String", 2),
        ("limit", "integer", 1),
    }
