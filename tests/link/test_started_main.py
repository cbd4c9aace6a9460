"""What the `main` of a Python program is given by a console script: nothing."""

from __future__ import annotations

from typing import Any

import pytest

PROGRAM = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class D(Node):
    def __init__(self, namespace, topic):
        super().__init__('d', namespace=namespace)
        self.create_publisher(String, topic, 1)


def main(args=None, namespace=None, topic='x'):
    rclpy.init(args=args)
    rclpy.spin(D(namespace, topic))
"""


@pytest.mark.parametrize(
    ("end", "expected"),
    [
        ("", "/x"),
        ("main()", "/x"),
        ("main(sys.argv)", "/x"),
        ("main(namespace='a', topic='y')", "/{namespace}/y"),
        ("main(sys.argv, topic='y')", "/y"),
        ("main(**given)", "/{namespace}/{value}"),
    ],
)
def test_what_main_is_given(workspace: Any, end: str, expected: str) -> None:
    """Its parameters have their defaults, where the file itself does not hand it something."""
    found = workspace.package(
        {"pkg/d.py": PROGRAM + (f"\n\nif __name__ == '__main__':\n    {end}\n" if end else "")}
    ).interfaces()
    assert [each.name for each in found if each.role == "publisher"] == [expected]
