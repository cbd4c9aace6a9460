"""Tables and lists that a class makes of those of its base: Python."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import pytest

CODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Base(Node):
    TOPICS = {base}
    def __init__(self, name):
        super().__init__(name)
        for topic in {loop}:
            self.create_publisher(String, {name}, 10)
class Demo(Base):
{own}
    def __init__(self):
        super().__init__("demo")
{behind}
def main():
    rclpy.spin(Demo())
"""
TABLE = '{"a": "x/a", "b": "x/b"}'
VALUES = "self.TOPICS.values()"
KEYS = "self.TOPICS"
LIST = "list(self.TOPICS)"
ALL = ["/x/a", "/x/b", "/y/c"]
OPEN = ["open"]
ROWS = {
    "spread": (TABLE, VALUES, 'TOPICS = {**Base.TOPICS, "c": "y/c"}', "", ALL),
    "spread over": (TABLE, VALUES, 'TOPICS = {**Base.TOPICS, "b": "y/c"}', "", ["/x/a", "/y/c"]),
    "dict": (TABLE, VALUES, 'TOPICS = dict(Base.TOPICS, c="y/c")', "", ALL),
    "dict by its keys": (TABLE, KEYS, 'TOPICS = dict(Base.TOPICS, c="y/c")', "", ALL),
    "spread by its keys": (TABLE, KEYS, 'TOPICS = {**Base.TOPICS, "c": "y/c"}', "", ALL),
    "or": (TABLE, VALUES, 'TOPICS = Base.TOPICS | {"c": "y/c"}', "", ALL),
    "list and list": ('["x/a", "x/b"]', LIST, 'TOPICS = Base.TOPICS + ["y/c"]', "", ALL),
    "spread tuple": ('("x/a", "x/b")', LIST, 'TOPICS = [*Base.TOPICS, "y/c"]', "", ALL),
    "the same one, and more": (TABLE, VALUES, 'TOPICS = Base.TOPICS\nTOPICS["c"] = "y/c"', "", OPEN),
    "changed by another name": ('["x/a", "x/b"]', LIST, 'MORE = Base.TOPICS\nMORE.append("y/c")', "", OPEN),
    "changed later": (TABLE, VALUES, 'TOPICS = {**Base.TOPICS, "c": "z"}', 'Demo.TOPICS["c"] = "y/c"', OPEN),
    "changed in between": ('["x/a"]', LIST, 'TOPICS = Base.TOPICS[:]\nTOPICS.append("x/b")\nTOPICS += ["y/c"]', "", OPEN),
}  # fmt: skip


@pytest.mark.parametrize(("base", "loop", "own", "behind", "expected"), ROWS.values(), ids=ROWS)
def test_tables_of_bases(workspace: Any, base: str, loop: str, own: str, behind: str, expected: list[str]) -> None:
    """A table that is made of another one has what both say; one that somebody may change is open."""
    name = "self.TOPICS[topic]" if loop == KEYS else "topic"
    text = CODE.format(name=name, base=base, loop=loop, own=indent(own, "    "), behind=behind)
    found = [one for one in workspace.package({"demo.py": text}).interfaces() if one.role == "publisher"]
    told = sorted(str(one.name) for one in found)
    assert told == expected or (expected == OPEN and {one.confidence for one in found} <= {"pattern", "one_of"})
