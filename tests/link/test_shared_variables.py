"""Lists, tables and objects of Python that stand in another module, or in a class."""

from __future__ import annotations

from typing import Any

import pytest

SHARED = """
class Config:
    TOPIC = "a"
    LIST = ["k"]
    TABLE = {"x": "f"}
class Made:
    def __init__(self, topic):
        self.topic = topic
        self.other = "n"
    def change(self, other): self.other = other
TEXT = "t"
LIST = ["b", "c"]
TABLE = {"x": "d", "in": {"y": "e"}}
OBJECT = Made("o")
"""
NODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from pkg import shared
from pkg.shared import Config, LIST, OBJECT, TABLE, TEXT
class Demo(Node):
    OWN = {{"x": "g"}}
    def __init__(self):
        super().__init__("demo")
        for name in {names}:
            self.create_publisher(String, name, 1)
def main():
    {before}
    rclpy.spin(Demo())
"""
SETUP = "from setuptools import setup\nsetup(name='pkg', packages=['pkg'], entry_points={'console_scripts': ['d = pkg.d:main']})\n"
ROWS = [
    ("a list", "LIST", "", ["b", "c"]),
    ("a list behind its module", "shared.LIST", "", ["b", "c"]),
    ("a list that grows", "LIST", 'LIST.append("z")', []),
    ("a list that grows behind its module", "LIST", 'shared.LIST.append("z")', []),
    ("another list of that name", "LIST", 'NAMES = []\n    NAMES.append("z")', ["b", "c"]),
    ("a table", '[TABLE["x"], shared.TABLE["in"]["y"]]', "", ["d", "e"]),
    ("a table that is changed", '[TABLE["x"]]', 'TABLE["x"] = input()', []),
    ("a text", "[shared.TEXT]", "", ["t"]),
    ("a text that is replaced", "[shared.TEXT]", "shared.TEXT = input()", ["t"]),
    ("variables of a class", '[Config.TOPIC, Config.LIST[0], Config.TABLE["x"]]', "", ["a", "f", "k"]),
    ("a table of a class that is changed", '[Config.TABLE["x"]]', 'Config.TABLE["x"] = input()', []),
    ("a table of the own class", '[self.OWN["x"], Demo.OWN["x"]]', "", ["g"]),
    ("a table of the own class that is changed", '[self.OWN["x"]]', 'Demo.OWN["x"] = input()', []),
    ("an object", "[OBJECT.topic, shared.OBJECT.topic]", "", ["o"]),
    ("an object that changes itself", "[OBJECT.other]", "OBJECT.change(input())", []),
    ("an object that is changed", "[OBJECT.topic]", "OBJECT.topic = input()", []),
    ("an object that is changed by another name", "[OBJECT.topic]", "it = OBJECT\n    it.topic = input()", []),
]  # fmt: skip


@pytest.mark.parametrize(("names", "before", "expected"), [row[1:] for row in ROWS], ids=[row[0] for row in ROWS])
def test_what_others_have_is_told_while_nobody_changes_it(
    workspace: Any, names: str, before: str, expected: list[str]
) -> None:
    """What somebody may change has a hole beside what is known of it, and nothing is proved."""
    node = NODE.format(names=names, before=before or "pass")
    package = workspace.package({"pkg/d.py": node, "pkg/shared.py": SHARED, "pkg/__init__.py": "", "setup.py": SETUP})
    found = [entry for entry in package.interfaces() if entry.role == "publisher"]
    known = sorted(entry.name for entry in found if "{" not in entry.name)
    assert known == [f"/{name}" for name in expected]
    is_changed = before and "NAMES" not in before
    assert any("{" in entry.name for entry in found) == bool(is_changed)
    assert all(entry.confidence == "folded" for entry in found) != bool(is_changed)


DERIVED = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Base:
    NAMES = ["a"]
    def __init__(self, node):
        for name in self.NAMES:
            node.create_publisher(String, name, 1)
class Other(Base):
    NAMES = ["b"]
def main():
    node = rclpy.create_node("demo")
    Base(node)
    Other(node)
"""


def test_a_list_that_a_derived_class_has_anew_is_not_that_of_its_base_alone(workspace: Any) -> None:
    """The base makes the endpoints of both lists: each object those of its own class."""
    package = workspace.package({"pkg/d.py": DERIVED, "pkg/__init__.py": "", "setup.py": SETUP})
    found = [entry for entry in package.interfaces() if entry.role == "publisher"]
    assert {(entry.name, entry.confidence) for entry in found} == {("/a", "folded"), ("/b", "folded")}
