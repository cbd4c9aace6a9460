"""Enumerations of Python: what their members are called, and loops over them."""

from __future__ import annotations

from typing import Any

import pytest

PROGRAM = """
import enum
from rclpy.node import Node
from std_msgs.msg import String


class Keys(str, enum.Enum):
    DEPTH = 'max_depth'
    LOW = 'low'


class Twice(enum.Enum):
    A = 'a'
    B = 'a'


class Plain:
    A = 'a'


class D(Node):
    def __init__(self):
        super().__init__('d')
        {body}
"""
ROWS = [
    ("self.create_publisher(String, Keys.DEPTH.name, 1)", ["/DEPTH"]),
    ("key = Keys.LOW\n        self.create_publisher(String, key.name, 1)", ["/LOW"]),
    ("for key in Keys:\n            self.create_publisher(String, f'x/{key.name}', 1)", ["/x/DEPTH", "/x/LOW"]),
    ("self.all = [self.create_publisher(String, key.value, 1) for key in Keys]", ["/low", "/max_depth"]),
    ("for key in Twice:\n            self.create_publisher(String, key.value, 1)", ["/a"]),
    ("self.create_publisher(String, Plain.A.name, 1)", ["/{name}"]),
    ("self.create_publisher(String, Keys.OTHER.name, 1)", ["/{name}"]),
]


@pytest.mark.parametrize(("body", "expected"), ROWS, ids=[row[0][:44] for row in ROWS])
def test_members_of_an_enumeration(workspace: Any, body: str, expected: list[str]) -> None:
    """Each is called as it is written; a second one of the same value is none of them."""
    found = workspace.package({"pkg/d.py": PROGRAM.replace("{body}", body)}).interfaces()
    assert sorted(each.name for each in found if each.role == "publisher") == expected
