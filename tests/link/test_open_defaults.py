"""A parameter that one branch declares with what nobody sees has no default, whatever another branch says."""

from __future__ import annotations

from typing import Any

import pytest

NODE = """
import rclpy
from rclpy.node import Node
class Demo(Node):
    def __init__(self, config):
        super().__init__("demo")
        try:
            self.declare_parameter("rate", {first})
        except KeyError:
            self.declare_parameter("rate", 2)
        self.rate = self.get_parameter("rate").value
def main():
    rclpy.spin(Demo(read()))
"""
SETUP = "from setuptools import setup\nsetup(name='pkg', entry_points={'console_scripts': ['demo = pkg.demo:main']})\n"


@pytest.mark.parametrize(
    ("first", "told"),
    [
        pytest.param('config["rate"]', (None, None), id="of_a_file"),
        pytest.param('float(config["rate"])', (None, "double"), id="of_a_known_type"),
        pytest.param("2", (2, "integer"), id="the_same"),
        pytest.param("None", (2, "integer"), id="none"),
        pytest.param("rclpy.Parameter.Type.INTEGER", (2, "integer"), id="a_type"),
    ],
)
def test_a_default_is_that_of_all_lines_that_declare(workspace: Any, first: str, told: tuple[Any, Any]) -> None:
    """What a run that takes the other branch declares is not told as what all declare."""
    files = {"pkg/__init__.py": "", "pkg/demo.py": NODE.format(first=first), "setup.py": SETUP}
    found = [(each.default, each.type) for each in workspace.package(files).interfaces() if each.role == "parameter"]
    assert told in found
    assert all(default == told[0] for default, _ in found)
