"""Profiles of QoS that are changed behind their use, by another name, or in the constructor of their own class."""

from __future__ import annotations

from typing import Any

import pytest

CPP = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
struct Slow : rclcpp::QoS {{
  explicit Slow(bool sensor) : rclcpp::QoS(7) {{ if (sensor) {{ best_effort(); }} else {{ transient_local(); }} }}
}};
struct Open : rclcpp::QoS {{ Open() : rclcpp::QoS(7) {{ if (given()) best_effort(); }} }};
class Demo : public rclcpp::Node {{
 public:
  Demo() : Node("demo") {{ {body} }}
  rclcpp::QoS & profile() {{ return qos_; }}
  rclcpp::QoS qos_{{4}};
}};
"""
MAKE = 'create_publisher<std_msgs::msg::String>("out", {});'
MADE = [
    (MAKE.format("Slow(true)"), ("best_effort", "volatile", 7)),
    (MAKE.format("Slow(false)"), ("reliable", "transient_local", 7)),
    (MAKE.format("Open()"), ("unknown", "volatile", 7)),
    (MAKE.format("qos_") + " qos_.best_effort();", ("reliable", "volatile", 4)),
    ("qos_.best_effort(); " + MAKE.format("qos_"), ("best_effort", "volatile", 4)),
    ("auto & other = qos_; other.best_effort(); " + MAKE.format("qos_"), ("best_effort", "volatile", 4)),
    ("profile().best_effort(); " + MAKE.format("qos_"), ("best_effort", "volatile", 4)),
]
PYTHON = """
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String
class Latched(QoSProfile):
    def __init__(self, sensor=False, **more):
        super().__init__(durability=DurabilityPolicy.TRANSIENT_LOCAL, **more)
        if sensor:
            self.reliability = ReliabilityPolicy.BEST_EFFORT
class Named(QoSProfile):
    pass
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        table = {{"a": QoSProfile(depth=10)}}
        {body}
"""
MAKE_PYTHON = 'self.create_publisher(String, "out", {})'
MADE_PYTHON = [
    (MAKE_PYTHON.format("Latched(depth=2)"), ("reliable", "transient_local", 2)),
    (MAKE_PYTHON.format("Latched(True, depth=2)"), ("best_effort", "transient_local", 2)),
    (MAKE_PYTHON.format("Named(depth=3)"), ("reliable", "volatile", 3)),
    (MAKE_PYTHON.format('table["a"]'), ("reliable", "volatile", 10)),
    ('q = table["a"]; q.depth = 5; ' + MAKE_PYTHON.format('table["a"]'), ("unknown", "unknown", None)),
    ('q = table.get("a"); q.depth = 5; ' + MAKE_PYTHON.format('table["a"]'), ("unknown", "unknown", None)),
    ("q = QoSProfile(depth=1); q.depth = 5; " + MAKE_PYTHON.format('table["a"]'), ("reliable", "volatile", 10)),
]


def _told(workspace: Any, files: dict[str, str]) -> tuple[str, str, int | None]:
    found = workspace.package(files).only("publisher").qos
    return found.reliability, found.durability, found.depth


@pytest.mark.parametrize(("body", "told"), MADE, ids=[row[0] for row in MADE])
def test_what_a_profile_of_cpp_is_where_it_is_used(workspace: Any, body: str, told: tuple[str, str, int]) -> None:
    """A branch of a profile's own constructor counts by its argument, a change of a member from where it stands on."""
    assert _told(workspace, {"src/d.cpp": CPP.format(body=body)}) == told


@pytest.mark.parametrize(("body", "told"), MADE_PYTHON, ids=[row[0] for row in MADE_PYTHON])
def test_what_a_profile_of_python_is_where_it_is_used(workspace: Any, body: str, told: tuple[str, str, int]) -> None:
    """What a class of the tree hands to its base counts, and an element is open once another name of it changes it."""
    assert _told(workspace, {"pkg/d.py": PYTHON.format(body=body)}) == told
