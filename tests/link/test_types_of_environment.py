"""Parameters whose default a variable of the environment gives."""

from __future__ import annotations

from typing import Any

ENVIRONMENT = """
import os
import rclpy
from rclpy.node import Node

class N(Node):
    def __init__(self):
        super().__init__("n")
        fallback = "http://localhost"
        url = os.environ.get("URL", fallback)
        self.declare_parameter("{name}", {default})

def main():
    rclpy.init()
    rclpy.spin(N())
"""


def test_what_the_environment_gives_is_a_text_without_a_default(workspace: Any) -> None:
    """Which text it is, is only known when it runs; without one that stands for it there may be none at all."""
    found = workspace.package({"pkg/n.py": ENVIRONMENT.format(name="url", default="url")}).only("parameter")
    assert (found.type, found.default) == ("string", None)
    none = ENVIRONMENT.format(name="key", default='os.environ.get("KEY")')
    assert workspace.package({"pkg/n.py": none}).only("parameter").type is None
