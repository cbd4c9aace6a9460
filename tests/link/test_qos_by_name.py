"""Profiles and policies that a name tells: of the client libraries, and of a tree that calls something alike."""

from __future__ import annotations

from typing import Any

import pytest
from ecm_checker.contract import Qos

PYTHON = """
from enum import Enum
import rclpy
from rclpy import qos
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSPresetProfiles as Presets, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String


class Profiles:
    PARAMETERS = QoSProfile(depth=3, reliability=ReliabilityPolicy.BEST_EFFORT)


class Chosen(Enum):
    SENSOR_DATA = QoSProfile(depth=6)


class D(Node):
    SERVICES_DEFAULT = QoSProfile(depth=4)

    def __init__(self):
        super().__init__('d')
        default = QoSProfile(depth=1)
        reliable = choose()
        volatile = DurabilityPolicy.TRANSIENT_LOCAL
        self.create_publisher(String, 'a', {qos})
"""
UNSEEN = ("unknown", "unknown", "unknown", None)
ROWS = [
    ("Profiles.PARAMETERS", ("best_effort", "volatile", "keep_last", 3)),
    ("Chosen.SENSOR_DATA.value", ("reliable", "volatile", "keep_last", 6)),
    ("self.SERVICES_DEFAULT", ("reliable", "volatile", "keep_last", 4)),
    ("self.PARAMETERS", UNSEEN),
    ("default", ("reliable", "volatile", "keep_last", 1)),
    ("QoSPresetProfiles.DEFAULT.value", ("reliable", "volatile", "keep_last", 10)),
    ("Presets.SENSOR_DATA.value", ("best_effort", "volatile", "keep_last", 5)),
    ("qos.qos_profile_sensor_data", ("best_effort", "volatile", "keep_last", 5)),
    ("rclpy.qos.QoSPresetProfiles.PARAMETERS.value", ("reliable", "volatile", "keep_last", 1000)),
    ("QoSProfile(depth=2, reliability=reliable)", ("unknown", "volatile", "keep_last", 2)),
    ("QoSProfile(depth=2, durability=volatile)", ("reliable", "transient_local", "keep_last", 2)),
]


def four(qos: Qos | None) -> tuple[Any, ...]:
    """Return the policies that every row gives."""
    assert qos is not None
    return (qos.reliability, qos.durability, qos.history, qos.depth)


@pytest.mark.parametrize(("written", "expected"), ROWS, ids=[row[0] for row in ROWS])
def test_a_profile_that_a_name_tells(workspace: Any, written: str, expected: tuple[Any, ...]) -> None:
    """What the tree calls as the library does is what the tree makes of it; the rest is a preset by its enumeration."""
    text = PYTHON.replace("{qos}", written)
    assert four(workspace.package({"pkg/d.py": text}).only("publisher").qos) == expected


CPP = """
class {name} : public rclcpp::QoS {{ public: {name}() : rclcpp::QoS(3) {{ best_effort(); }} }};
class D : public rclcpp::Node {{
 public:
  D() : Node("d") {{
    bool reliable = declare_parameter("reliable", false);
    create_publisher<std_msgs::msg::String>("a", {qos});
  }}
}};
"""


@pytest.mark.parametrize(
    ("name", "qos", "expected"),
    [
        ("ParametersQoS", "ParametersQoS()", ("best_effort", "volatile", "keep_last", 3)),
        ("Own", "rclcpp::ParametersQoS()", ("reliable", "volatile", "keep_last", 1000)),
        ("Own", "rclcpp::QoS(2).reliability(reliable)", ("unknown", "volatile", "keep_last", 2)),
    ],
)
def test_a_profile_that_a_name_tells_in_cpp(workspace: Any, name: str, qos: str, expected: tuple[Any, ...]) -> None:
    """A class of the tree that is called as one of the library is its own."""
    text = CPP.format(name=name, qos=qos)
    assert four(workspace.package({"src/d.cpp": text}).only("publisher").qos) == expected
