"""Variables of classes of Python that methods change by the class of their object."""

from __future__ import annotations

from typing import Any

import pytest

TEXT = """
import rospy
from std_msgs.msg import String
class Part(object):
    topic = "one"
    {change}
    def go(self):
        rospy.Publisher({read}, String, queue_size=1)
rospy.init_node("demo")
Part().go()
"""
CHANGES = [
    '@classmethod\n    def change(cls):\n        cls.topic = "two"',
    'def change(self):\n        self.__class__.topic = "two"',
    'def change(self):\n        type(self).topic = "two"',
    'def change(self):\n        Part.topic = "two"',
]
READS = ["self.topic", "Part.topic", "Part().topic"]
KEEPS = ['def change(self):\n        topic = "two"', 'def change(self):\n        type(self).other = "two"']


@pytest.mark.parametrize("read", READS)
@pytest.mark.parametrize("change", CHANGES)
def test_a_changed_variable_is_not_what_its_class_says(workspace: Any, change: str, read: str) -> None:
    """Whoever changes it by whatever way to the class leaves open what it is elsewhere."""
    found = workspace.package({"scripts/d.py": TEXT.format(change=change, read=read)}, ros=1).interfaces()
    told = {(entry.name, entry.confidence) for entry in found if entry.role == "publisher"}
    assert told
    assert not told & {("/one", "folded"), ("/one", "literal")}


@pytest.mark.parametrize("read", READS)
@pytest.mark.parametrize("change", KEEPS)
def test_what_nobody_changes_is_what_its_class_says(workspace: Any, change: str, read: str) -> None:
    """A local variable and a variable of another name are no change."""
    found = workspace.package({"scripts/d.py": TEXT.format(change=change, read=read)}, ros=1).only("publisher")
    assert (found.name, found.confidence) == ("/one", "folded")
