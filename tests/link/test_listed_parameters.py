"""Parameters that one call declares as a list have their defaults where they are read."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String

ALL = [("topic", "asked"), ("rate", 3)]


class D(Node):
    def __init__(self):
        super().__init__("d")
        {declared}
        self.sub = self.create_subscription(String, {read}, print, 1)


def main():
    rclpy.init()
    rclpy.spin(D())


if __name__ == "__main__":
    main()
"""
ROWS = [
    ("by position", 'self.declare_parameters("", [("topic", "asked")])', 'self.get_parameter("topic").value', "/asked"),
    (
        "by keyword",
        'self.declare_parameters(namespace="", parameters=[("rate", 3), ("topic", "asked")])',
        'self.get_parameter("topic").get_parameter_value().string_value',
        "/asked",
    ),
    (
        "below a namespace",
        'self.declare_parameters("camera", [("topic", "asked")])',
        'self.get_parameter("camera.topic").value',
        "/asked",
    ),
    ("of a module", 'self.declare_parameters("", ALL)', 'self.get_parameter("topic").value', "/asked"),
    (
        "with a descriptor",
        'self.declare_parameters("", [("topic", "asked", ParameterDescriptor())])',
        'self.get_parameter("topic").value',
        "/asked",
    ),
    (
        "by type alone",
        'self.declare_parameters("", [("topic", Parameter.Type.STRING)])',
        'self.get_parameter("topic").value',
        "/{topic}",
    ),
    (
        "below what nobody shows",
        'self.declare_parameters(chosen(), [("topic", "asked")])',
        'self.get_parameter("topic").value',
        "/{topic}",
    ),
    (
        "one by one",
        "for name, value in ALL: self.declare_parameter(name, value)",
        'self.get_parameter("topic").value',
        "/asked",
    ),
]


@pytest.mark.parametrize(("declared", "read", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_read_of_a_listed_parameter(workspace: Any, declared: str, read: str, expected: str) -> None:
    """Its default is what the list gives it, by the whole name."""
    text = NODE.format(declared=declared, read=read)
    assert workspace.package({"pkg/d.py": text}).only("subscriber").name == expected


def test_a_namespace_that_nobody_shows_stays_open(workspace: Any) -> None:
    """The names of parameters below it are no names without it."""
    text = NODE.format(declared='self.declare_parameters(chosen(), [("topic", "asked")])', read='"x"')
    assert workspace.package({"pkg/d.py": text}).only("parameter").name == "{chosen}.topic"
