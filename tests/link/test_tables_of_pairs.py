"""Tables and lists that classes of `collections` are, or that are made of pairs: Python."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import pytest

CODE = """
from collections import OrderedDict, deque
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
NAMES = ["a", "b"]
class Demo(Node):
    def __init__(self, given):
        super().__init__("demo")
{body}
def main():
    rclpy.spin(Demo(input()))
"""
LOOP = "for key, value in {0}.items():\n    self.create_publisher(String, key + value, 10)"
EACH = "for each in {0}:\n    self.create_publisher(String, each, 10)"
ROWS = {
    "pairs": (LOOP.format('OrderedDict([("a", "x"), ("b", "y")])'), ["/ax", "/by"]),
    "pairs of two lists": (LOOP.format('dict(zip(NAMES, ["x", "y"]))'), ["/ax", "/by"]),
    "by names": (LOOP.format('OrderedDict(a="x")'), ["/ax"]),
    "no pairs": (LOOP.format('dict([("a", "x"), given])'), None),
    "a list": (EACH.format('deque(["x", "y"])'), ["/x", "/y"]),
    "a list that ends": (EACH.format('deque(["x", "y"], 1)'), None),
    "a list that turns": ('rows = deque(["x", "y"])\nrows.rotate(1)\n' + EACH.format("[rows[0]]"), None),
}  # fmt: skip


@pytest.mark.parametrize(("body", "expected"), ROWS.values(), ids=ROWS)
def test_tables_of_pairs(workspace: Any, body: str, expected: list[str] | None) -> None:
    """They have what they are made of; where not all of that is known, nothing is told as proved."""
    found = workspace.package({"demo.py": CODE.format(body=indent(body, " " * 8))}).interfaces()
    told = [one for one in found if one.role == "publisher"]
    if expected is not None:
        assert sorted(str(one.name) for one in told) == expected
    else:
        assert not {"literal", "folded"} & {one.confidence for one in told}
