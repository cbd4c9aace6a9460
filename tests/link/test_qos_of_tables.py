"""Profiles of Python that stand in tables, are copied, spread, or asked for by a text."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
import copy
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile, ReliabilityPolicy, qos_profile_sensor_data
from std_msgs.msg import String
TABLE = {{"sensor": qos_profile_sensor_data, "latched": QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)}}
WORDS = {{"reliability": "best_effort", "depth": 4}}
def built(words):
    return QoSProfile(depth=words["depth"], reliability=ReliabilityPolicy[words["reliability"].upper()])
def changed():
    found = copy.deepcopy(qos_profile_sensor_data)
    found.depth = 3
    return found
class Demo(Node):
    def __init__(self, given):
        super().__init__("demo")
        depth = self.declare_parameter("depth", 6).get_parameter_value().integer_value
        self.create_publisher(String, "chatter", {profile})
"""
ROWS = [
    ("a table", 'TABLE["sensor"]', ("best_effort", "volatile", 5)),
    ("a table that is asked", 'TABLE.get("latched")', ("reliable", "transient_local", 1)),
    ("a table without the key", 'TABLE.get("other", 10)', ("reliable", "volatile", 10)),
    ("a key that is open", "TABLE[given]", ("unknown", "unknown", None)),
    ("a short key", 'QoSPresetProfiles.get_from_short_key("sensor_data")', ("best_effort", "volatile", 5)),
    ("a short key that is open", "QoSPresetProfiles.get_from_short_key(given)", ("unknown", "unknown", None)),
    ("words of a table", "built(WORDS)", ("best_effort", "volatile", 4)),
    ("a copy that is changed", "changed()", ("best_effort", "volatile", 3)),
    ("numbers", "QoSProfile(depth=1, reliability=2, durability=1)", ("best_effort", "transient_local", 1)),
    ("getattr", 'QoSProfile(depth=1, reliability=getattr(ReliabilityPolicy, "BEST_EFFORT"))',
     ("best_effort", "volatile", 1)),
    ("what is spread", 'QoSProfile(**dict(depth=2, durability=DurabilityPolicy.TRANSIENT_LOCAL))',
     ("reliable", "transient_local", 2)),
    ("what is spread and open", "QoSProfile(**given)", ("unknown", "unknown", None)),
    ("a number of a parameter", "QoSProfile(depth=depth)", ("reliable", "volatile", 6)),
]  # fmt: skip


@pytest.mark.parametrize(("profile", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_a_profile_is_what_is_found(workspace: Any, profile: str, expected: tuple[str, str, int | None]) -> None:
    """What is found counts, what is open is unknown: spread arguments were left out, and the rest open."""
    workspace.package({"pkg/demo.py": NODE.format(profile=profile)})
    qos = workspace.only("publisher").qos
    assert (qos.reliability, qos.durability, qos.depth) == expected
