"""Lists and objects of Python that several variables, fields and objects have: who changes one changes all of them."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from elsewhere import work


class Holder:
    def __init__(self, name):
        self.name = name
        self.ref = []

    def change(self):
        self.ref[0] = "changed"

    def change_within(self):
        self.ref[0][0] = "changed"

    def look(self):
        return self.ref[0]


class Demo(Node):
    def __init__(self, name):
        super().__init__("demo")
        {body}

    def fill(self):
        self.rows[0] = "changed"

    def hand_on(self, function):
        function(self)

    def set_field(self):
        self.rows.topic = "changed"


def change_field(holder):
    holder.ref[0] = "changed"


def change_rows(node):
    node.rows[0] = "changed"


def main():
    rclpy.init()
    rclpy.spin(Demo("map"))
"""
PUB, OPEN = "self.create_publisher(String, {}, 10)", "{item}"
FIRST = PUB.format("b[0]")
CHANGED = [
    ("field of an object, by its method", 'b = ["image"]; x = Holder(name); x.ref = b; x.change()', FIRST, OPEN),
    ("list in a field", 'b = ["image"]; x = Holder(name); x.ref = [b]; x.change_within()', FIRST, OPEN),
    ("field of an object, by a function", 'b = ["image"]; x = Holder(name); x.ref = b; change_field(x)', FIRST, OPEN),
    ("field of an object, by somebody", 'b = ["image"]; x = Holder(name); x.ref = b; work(x)', FIRST, OPEN),
    ("list with the name that is handed on", 'b = ["a", name]; x = Holder(name); x.ref = b; work(x)', FIRST, OPEN),
    ("member, by an own method", 'b = ["image"]; self.rows = b; self.fill()', FIRST, OPEN),
    ("member, by a function", 'b = ["image"]; self.rows = b; change_rows(self)', FIRST, OPEN),
    ("member, by a function that is handed on", 'b = ["image"]; self.rows = b; self.hand_on(change_rows)', FIRST, OPEN),
    ("table of fields", 'b = ["image"]; x = Holder(name); x.__dict__.update(ref=b); x.change()', FIRST, OPEN),
    ("method that a variable has", 'b = ["image"]; put = b.append; put("x")', PUB.format("b[-1]"), OPEN),
    ("list in a list", 'a = ["image"]; b = [a, name]; work(a)', PUB.format("b[0][0]"), OPEN),
    ("one of two names", 'b = ["image", name]; c = b; work([c, name])', FIRST, OPEN),
    ("field of what a member is", 'b = Holder("q"); b.topic = "image"; self.rows = b; self.set_field()',
     PUB.format("b.topic"), "changed"),
]  # fmt: skip
LEFT = [
    ("who only looks", 'b = ["image"]; x = Holder(name); x.ref = b; x.look()', FIRST, "image"),
    ("a list that has the name", 'b = ["image", name]; work(name)', FIRST, "image"),
    ("the name in a list", 'b = ["image", name]; work(name)', PUB.format("b[1]"), "map"),
    ("a member that has the name", 'self.b = ["image", name]; self.x = Holder(name)', PUB.format("self.b[0]"), "image"),
    ("a list that was appended to", 'b = ["image"]; b.append(name); work(name)', PUB.format("b[1]"), "map"),
    ("a table that has the name", 't = {"a": name}; work(name)', PUB.format('t["a"]'), "map"),
    ("the elements of a list", 'b = ["image", name]\n        for each in b:\n            work(each)', FIRST, "image"),
    ("a text that a table has", 'self.own = name; t = {"a": work(self.own)}; t.setdefault("b", 1)',
     PUB.format("self.own"), "map"),
]  # fmt: skip


@pytest.mark.parametrize(("begin", "ask", "told"), [row[1:] for row in CHANGED], ids=[row[0] for row in CHANGED])
def test_what_somebody_may_have_changed_is_not_told_as_it_was(workspace: Any, begin: str, ask: str, told: str) -> None:
    """A list is changed by whoever has it, an object that has it or a method of it."""
    assert _told(workspace, begin, ask) == told


@pytest.mark.parametrize(("begin", "ask", "told"), [row[1:] for row in LEFT], ids=[row[0] for row in LEFT])
def test_texts_in_lists_stay(workspace: Any, begin: str, ask: str, told: str) -> None:
    """Whoever gets a text of a list cannot change the list, nor the text."""
    assert _told(workspace, begin, ask) == told


def _told(workspace: Any, begin: str, ask: str) -> str:
    package = workspace.package({"pkg/d.py": SOURCE.replace("{body}", f"{begin}\n        {ask}")})
    return str(package.only("publisher").name).removeprefix("/")
