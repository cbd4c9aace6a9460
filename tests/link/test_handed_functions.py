"""Functions of a module that are handed to whoever calls them for a name: Python."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import pytest

CODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
from other import tools
def left(name): return "left/" + name
def right(name="r"): return "right/" + name
@tools.wrapped
def odd(name): return "odd/" + name
def publish(node, namer):
    node.create_publisher(String, namer("x"), 10)
def publish_other(node, namer):
    namer = tools.other(namer)
    node.create_publisher(String, namer("x"), 10)
def on(node, namer): publish(node, namer)
class Side:
    def __init__(self, node, namer=left): node.create_publisher(String, namer("x"), 10)
class Demo(Node):
    def __init__(self, given):
        super().__init__("demo")
{body}
def main():
    rclpy.spin(Demo(input()))
"""
ROWS = {
    "a function gets it": ("publish(self, left)", ["/left/x"]),
    "two are handed": ("publish(self, left)\npublish(self, right)", ["/left/x", "/right/x"]),
    "handed on": ("on(self, right)", ["/right/x"]),
    "a constructor gets it": ("Side(self, right)", ["/right/x"]),
    "the default": ("Side(self)", ["/left/x"]),
    "a variable has it": ('namer = left\nself.create_publisher(String, namer("x"), 10)', ["/left/x"]),
    "one of two": ('namer = left if given else right\nself.create_publisher(String, namer("x"), 10)', None),
    "a decorated one": ("publish(self, odd)", None),
    "another one is called": ("publish_other(self, left)", None),
    "one that is not known": ("publish(self, given)", None),
}


@pytest.mark.parametrize(("body", "expected"), ROWS.values(), ids=ROWS)
def test_handed_functions(workspace: Any, body: str, expected: list[str] | None) -> None:
    """Whoever calls what it was handed has what that gives; of one that nobody knows the name is open."""
    modules = workspace.package({"demo.py": CODE.format(body=indent(body, " " * 8))}).modules()
    found = modules["ecm.pkg.demo"].signature.interfaces
    told = [one for one in found if one.role == "publisher"]
    if expected is not None:
        assert sorted(str(one.name) for one in told) == expected
    else:
        assert told
        assert not {"literal", "folded"} & {one.confidence for one in told}
