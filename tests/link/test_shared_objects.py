"""Objects of Python that have several names, or lie in lists: changed by one, they are changed for all."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
from rclpy.node import Node
from std_msgs.msg import String

class Topic:
    def __init__(self, name):
        self.name = name
    def full(self):
        return "/" + self.name

class Demo(Node):
    def __init__(self, other, each):
        super().__init__("demo")
        first = Topic("x")
        {change}
        self.create_publisher(String, first.full(), 10)
"""
CHANGED = [
    (
        "an element, handed to others before",
        "items = [first, Topic(other)]",
        "items[0].name = use(lambda: other, other)",
    ),
    ("an element of a list that grew", "items = []; items.append(first); items.append(other)", 'items[0].name = "n"'),
    ("an element of an element", "items = [first]; outer = [items]", 'outer[0][0].name = "n"'),
    ("an element of an element by name", "items = [first]; outer = [items]; inner = outer[0]", 'inner[0].name = "n"'),
    ("what an element is called", "items = [first]; second = items[0]", 'second.name = "n"'),
    ("one of several", "items = (first, other); second, third = items", 'second.name = "n"'),
    ("what a table gives", 'table = {"k": first}; second = table.get("k")', 'second.name = "n"'),
    ("what a function picks", "second = next(iter([first]))", 'second.name = "n"'),
    ("one of two", "items = [first]; second = items[0] if other else items[-1]", 'second.name = "n"'),
    ("elements with numbers", "items = [first]", 'for at, second in enumerate(items): second.name = "n"'),
    (
        "elements that grew in a loop",
        "items = [first]",
        'for one in each: items.append(one)\n        items[0].name = "n"',
    ),
]
KEPT = [
    ("what was made of the same text", 'text = "y"; second = [Topic(text)]', 'second[0].name = "n"'),
    ("another object", 'items = [first]; second = Topic("y")', 'second.name = "n"'),
]


def _name(workspace: Any, *change: str) -> str:
    text = NODE.format(change="\n        ".join(change))
    return str(workspace.package({"demo/d.py": text}).only("publisher").name)


@pytest.mark.parametrize(("before", "change"), [row[1:] for row in CHANGED], ids=[row[0] for row in CHANGED])
def test_what_one_name_changes_is_changed_for_all(workspace: Any, before: str, change: str) -> None:
    """The name that the object was made with is stale."""
    assert "{" in _name(workspace, before, change)


@pytest.mark.parametrize(("before", "change"), [row[1:] for row in KEPT], ids=[row[0] for row in KEPT])
def test_what_is_no_part_of_what_is_changed_is_kept(workspace: Any, before: str, change: str) -> None:
    """Texts never change, and a field of one object is none of another."""
    assert _name(workspace, before, change) == "/x"
