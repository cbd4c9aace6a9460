"""Fields that `setattr` gives by names that a run tells: Python."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import pytest

CODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Settings:
    name = "none"
    def __init__(self, **given):
        for key, value in given.items():
            setattr(self, key, value)
class Demo(Node):
    def __init__(self):
        super().__init__("demo")
        self.other = "kept"
{body}
        self.create_publisher(String, {name}, 10)
    def any(self):
        return self.get_parameters_by_prefix("")
def main():
    rclpy.spin(Demo())
"""
LOOP = 'for side in ("left", "right"):\n    setattr(self, side + "_topic", "arm/" + side)'
READ = (
    'for key, value in (("rate", 3), ("topic", "x")):\n    setattr(self, key, self.declare_parameter(key, value).value)'
)
ROWS = {
    "a loop over names": (LOOP, "self.right_topic", ["/arm/right folded"]),
    "what others hold": (LOOP, "self.other", ["/kept folded"]),
    "values of parameters": (READ, "self.topic", ["/x default"]),
    "by names of arguments": ('made = Settings(name="b")', "made.name", ["/b folded"]),
    "a name that nobody tells": ('for key in self.any():\n    setattr(self, key, "x")', "self.other", None),
    "a name of two": ('key = "other" if self.any() else "b"\nsetattr(self, key, "x")', "self.other", None),
}


@pytest.mark.parametrize(("body", "name", "expected"), ROWS.values(), ids=ROWS)
def test_fields_by_computed_names(workspace: Any, body: str, name: str, expected: list[str] | None) -> None:
    """A field has what it is given by a name that is known; by one that is not, any field may have been given it."""
    text = CODE.format(body=indent(body, " " * 8), name=name)
    found = [one for one in workspace.package({"demo.py": text}).interfaces() if one.role == "publisher"]
    told = [f"{one.name} {one.confidence}" for one in found]
    assert told == expected if expected is not None else not {"literal", "folded"} & {one.confidence for one in found}
