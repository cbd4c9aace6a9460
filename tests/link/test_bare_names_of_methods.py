"""Functions of a module of Python that are called like a method of the class that calls them."""

from __future__ import annotations

from typing import Any

TEXT = """
import rclpy
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
def topic(name):
    return "function_" + name
def tune(profile):
    profile.reliability = ReliabilityPolicy.BEST_EFFORT
class Demo(Node):
    @staticmethod
    def kind(name):
        return "kind_" + name
    KIND = kind("x")
    def topic(self, name):
        return "method_" + name
    def tune(self, profile):
        profile.depth = 9
    def __init__(self):
        super().__init__("demo")
{body}
    def within(self):
        def topic(name):
            return "inner_" + name
        self.create_publisher(String, topic("a"), 1)
def main():
    rclpy.init()
    rclpy.spin(Demo())
"""
MAKE = "        self.create_publisher(String, {}, profile)\n"


def _found(workspace: Any, body: str) -> list[tuple[str, str, int | None]]:
    files = {"pkg/d.py": TEXT.format(body="        profile = QoSProfile(depth=2)\n" + body)}
    found = [entry for entry in workspace.package(files).interfaces() if entry.role == "publisher"]
    return [(entry.name, entry.qos.reliability, entry.qos.depth) for entry in found if "inner" not in entry.name]


def test_a_bare_name_is_no_method(workspace: Any) -> None:
    """Python finds a method by its object only: what is called without one is the function of the module."""
    body = "        tune(profile)\n" + MAKE.format('topic("a")')
    assert _found(workspace, body) == [("/function_a", "best_effort", 2)]


def test_a_name_of_the_object_is_the_method(workspace: Any) -> None:
    """With its object it is the method, whatever the module has."""
    body = "        self.tune(profile)\n" + MAKE.format('self.topic("a")')
    assert _found(workspace, body) == [("/method_a", "reliable", 9)]


def test_a_function_within_a_method_hides_both(workspace: Any) -> None:
    """What a method declares itself is nearest."""
    found = workspace.package({"pkg/d.py": TEXT.format(body="        self.within()\n")}).only("publisher")
    assert found.name == "/inner_a"


def test_the_body_of_a_class_finds_its_own_functions(workspace: Any) -> None:
    """While a class is made, names of its body are found without an object."""
    assert _found(workspace, MAKE.format("self.KIND")) == [("/kind_x", "reliable", 2)]
