"""QoS that is a member of its node, of which a method or another name of it changes a field."""

from __future__ import annotations

from typing import Any

import pytest

PYTHON = """
from rclpy.node import Node
from rclpy.qos import *
from std_msgs.msg import String
class D(Node):
    def __init__(self):
        super().__init__('d')
        self.q = QoSProfile(depth=3)
        {called}
        self.create_publisher(String, 'a', self.q)
    def fix(self):
        self.q.reliability = ReliabilityPolicy.BEST_EFFORT
"""
ROWS = [
    ("self.fix()", "best_effort"),
    ("self.fix(); self.q.depth = 3", "best_effort"),
    ("q = self.q; q.reliability = ReliabilityPolicy.BEST_EFFORT", "best_effort"),
    ("pass", "reliable"),
]


@pytest.mark.parametrize(("called", "expected"), ROWS, ids=[row[0] for row in ROWS])
def test_what_a_method_sets_of_a_member_counts_where_it_is_called(workspace: Any, called: str, expected: str) -> None:
    """It was told reliable, as if nothing had set it."""
    entry = workspace.package({"pkg/d.py": PYTHON.format(called=called)}).only("publisher")
    assert (entry.qos.reliability, entry.qos.depth) == (expected, 3)
