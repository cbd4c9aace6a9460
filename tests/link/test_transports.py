"""Transports of jsk_topic_tools, which publish what they are asked to and subscribe where somebody listens."""

from __future__ import annotations

from typing import Any

TEXT = """#!/usr/bin/env python
import rospy
from jsk_topic_tools import ConnectionBasedTransport
from std_msgs.msg import String
class Base(ConnectionBasedTransport):
    def __init__(self, namespace='~'):
        super(Base, self).__init__()
        self.pub = self.advertise(namespace + 'output', String, queue_size=3)
class Own(object):
    def __init__(self):
        self.advertise('none', String)
    def advertise(self, name, kind):
        pass
rospy.init_node('relay')
Base()
Own()
"""


def test_what_a_transport_advertises_is_a_publisher(workspace: Any) -> None:
    """A class with a method of that name which derives from no transport advertises nothing."""
    found = workspace.package({"scripts/relay.py": TEXT}, ros=1).only("publisher")
    assert (found.name, found.type, found.qos.depth) == ("/relay/output", "std_msgs/msg/String", 3)
