"""Of several methods of a name an object of Python runs the first of its line; `super()` leads on along that."""

from __future__ import annotations

from typing import Any

import pytest

CODE = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Mixin:
    def start(self, name="m"):
        self.create_publisher(String, name + "/mixin", 10)
class Other:
    def start(self{param}):
        {body}
class Demo({bases}, Node):
    def __init__(self):
        super().__init__("demo")
        self.start()
def main():
    rclpy.spin(Demo())
"""
ROWS = {
    "the first leads on": ("", 'super().start("x")', "Other, Mixin", {"/x/mixin"}),
    "the first leads on with its own": (', name="o"', 'super().start(name + "x")', "Other, Mixin", {"/ox/mixin"}),
    "the first alone": ("", "pass", "Other, Mixin", set()),
    "the other way round": ("", 'super().start("x")', "Mixin, Other", {"/m/mixin"}),
}


@pytest.mark.parametrize(("param", "body", "bases", "expected"), ROWS.values(), ids=ROWS)
def test_methods_of_mixins(workspace: Any, param: str, body: str, bases: str, expected: set[str]) -> None:
    """A method that stands behind another one of its name is called by that alone, with what that gives."""
    text = CODE.format(param=param, body=body, bases=bases)
    found = workspace.package({"demo.py": text}).interfaces()
    assert {one.name for one in found if one.role == "publisher"} == expected
