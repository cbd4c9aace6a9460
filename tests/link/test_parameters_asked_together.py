"""Parameters of which one call asks for several: Python."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import pytest

CODE = """
import rclpy
from rclpy.node import Node
from rclpy.parameter_client import AsyncParameterClient
from std_msgs.msg import String
class Demo(Node):
    def __init__(self, given):
        super().__init__("demo")
        self.declare_parameters("", [("car", "one"), ("alg", "two")])
        self.other = AsyncParameterClient(self, "other")
{body}
        self.create_publisher(String, {name} + "/x", 10)
def main():
    rclpy.spin(Demo(input()))
"""
ALL = 'self.get_parameters(["car", "alg"])'
ROWS = {
    "one of them": (f"found = {ALL}", "found[1].value", "/two/x"),
    "each by its name": (f"car, alg = {ALL}", "car.value", "/one/x"),
    "their values": (f"found = {ALL}\nfound = [each.value for each in found]", "found[0]", "/one/x"),
    "by a list with a name": ('names = ["car"]\nfound = self.get_parameters(names)', "found[0].value", "/one/x"),
    "a name that is not known": ('found = self.get_parameters(["car", given])', "found[0].value", None),
    "of another node": ('found = self.other.get_parameters(["car"])', "found[0].value", None),
}


@pytest.mark.parametrize(("body", "name", "expected"), ROWS.values(), ids=ROWS)
def test_parameters_asked_together(workspace: Any, body: str, name: str, expected: str | None) -> None:
    """Each is what its node declares as long as nobody sets it; where not all names are known, nothing is told."""
    found = workspace.package({"demo.py": CODE.format(body=indent(body, " " * 8), name=name)}).interfaces()
    (one,) = [one for one in found if one.role == "publisher" and str(one.name).endswith("x")]
    assert (one.name, one.confidence) == (expected, "default") if expected else one.confidence == "pattern"
