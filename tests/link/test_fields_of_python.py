"""Fields of Python that are given by their names as texts, or all at once."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Box:
    def __init__(self): self.n, self.m = "n", "m"
class Slot:
    def __init__(self): self.n = "n"
    def __setattr__(self, key, value): object.__setattr__(self, key, value + "_set")
class Demo(Node):
    def __init__(self, **given):
        super().__init__("demo")
        self.own, self.key = "own", "own"
        {body}
    def pub(self, name): self.create_publisher(String, name, 10)
def main():
    rclpy.spin(Demo())
"""
OPEN = "{}"
ROWS = [
    ("a field by its name", 'setattr(self, "own", "x"); self.pub(self.own)', "x"),
    ("an element of the fields", 'self.__dict__["own"] = "x"; self.pub(self.own)', "x"),
    ("an element of what is asked for", 'vars(self)["own"] = "x"; self.pub(self.own)', "x"),
    ("as the base gives fields", 'object.__setattr__(self, "own", "x"); self.pub(self.own)', "x"),
    ("an element is read", 'self.pub(self.__dict__["own"])', "own"),
    ("any field", "setattr(self, self.key, given); self.pub(self.own)", OPEN),
    ("many fields", "self.__dict__.update(given); self.pub(self.own)", OPEN),
    ("each of some", "for k, v in given.items(): setattr(self, k, v)\n        self.pub(self.own)", OPEN),
    ("within a list", "[setattr(self, k, v) for k, v in given.items()]; self.pub(self.own)", OPEN),
    ("a field of another object", 'b = Box(); setattr(b, "n", "x"); self.pub(b.n)', "x"),
    ("any field of another object", "b = Box(); setattr(b, given.popitem()[0], given); self.pub(b.m)", OPEN),
    ("another field of another object", "b = Box(); setattr(b, self.key, given); self.pub(b.m)", "m"),
    ("a field that is gone", 'delattr(self, "own"); self.pub(self.own)', OPEN),
    ("who takes fields otherwise", "self.pub(Slot().n)", OPEN),
]


@pytest.mark.parametrize(("body", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_fields_that_are_given_otherwise_are_not_told_as_they_were(workspace: Any, body: str, expected: str) -> None:
    """What is told as folded is what a run makes; what anybody may have given is not told as proved."""
    setup = (
        "from setuptools import setup\nsetup(name='pkg', entry_points={'console_scripts': ['demo = pkg.demo:main']})\n"
    )
    package = workspace.package({"pkg/__init__.py": "", "pkg/demo.py": NODE.format(body=body), "setup.py": setup})
    found = {(entry.name, entry.confidence) for entry in package.interfaces() if entry.role == "publisher"}
    if expected == OPEN:
        assert any("{" in name for name, _ in found)
        assert all(how != "folded" for _, how in found)
    else:
        assert found == {(f"/{expected}", "folded")}
