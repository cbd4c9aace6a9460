"""Lists of Python that are made of a few elements many times."""

from __future__ import annotations

from typing import Any

import pytest

SOURCE = """
import rclpy
from rclpy.node import Node

class N(Node):
    def __init__(self):
        super().__init__("n")
        count = {count}
        self.read("x", {value})

    def read(self, name, default):
        return [float(each) for each in self.declare_parameter(name, list(default)).value]

def main():
    rclpy.init()
    rclpy.spin(N())
"""


@pytest.mark.parametrize(
    ("count", "value", "default"),
    [
        ("2", "[0.5] * count", [0.5, 0.5]),
        ("2", "count * [0.5]", [0.5, 0.5]),
        ("1", "[0.5] * count + [1.5]", [0.5, 1.5]),
        ("given()", "[0.5] * count", None),
        ("2.0", "[0.5] * count", None),
    ],
)
def test_a_list_is_repeated(workspace: Any, count: str, value: str, default: Any) -> None:
    """Only a number that is known repeats it."""
    found = workspace.package({"pkg/n.py": SOURCE.format(count=count, value=value)}).only("parameter")
    assert found.default == default
