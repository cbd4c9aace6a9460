"""Objects that are made of others with some fields changed: Python."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import pytest

CODE = """
from collections import namedtuple
from dataclasses import dataclass, replace
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
Pair = namedtuple("Pair", "topic depth")
@dataclass
class Row:
    topic: str
    depth: int = 5
class Demo(Node):
    def __init__(self, **given):
        super().__init__("demo")
{body}
    def pub(self, row):
        pass
def main():
    rclpy.spin(Demo())
"""
MAKE = "self.create_publisher(String, {0}.topic, {0}.depth)"
ROWS = {
    "a named tuple": ('a = Pair("x", 3)\nb = a._replace(topic="y")\n' + MAKE.format("b"), "/y folded 3"),
    "a data class": ('a = Row("x")\nb = replace(a, topic=a.topic + "/y")\n' + MAKE.format("b"), "/x/y folded 5"),
    "twice": ('a = Row("x")\nb = replace(a, depth=2)\nc = replace(b, topic="z")\n' + MAKE.format("c"), "/z folded 2"),
    "the other one": ('a = Row("x")\nb = replace(a, topic="y")\n' + MAKE.format("a"), "/x folded 5"),
    "changed before": ('a = Row("x")\na.topic = "w"\nb = replace(a, depth=2)\n' + MAKE.format("b"), "open"),
    "changed later": ('a = Row("x")\nb = replace(a, depth=2)\nb.topic = "w"\n' + MAKE.format("b"), "/w folded 2"),
    "by a table": ('a = Row("x")\nb = replace(a, **given)\n' + MAKE.format("b"), "open"),
}


@pytest.mark.parametrize(("body", "expected"), ROWS.values(), ids=ROWS)
def test_replaced_fields(workspace: Any, body: str, expected: str) -> None:
    """A field that is given has its new value, another one that of the other object; else it is open."""
    found = workspace.package({"demo.py": CODE.format(body=indent(body, " " * 8))}).interfaces()
    (one,) = [one for one in found if one.role == "publisher"]
    if expected == "open":
        assert one.confidence in {"pattern", "one_of"} or one.name == "/w"
    else:
        assert f"{one.name} {one.confidence} {one.qos.depth}" == expected
